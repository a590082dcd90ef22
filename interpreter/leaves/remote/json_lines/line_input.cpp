#include "leaves/remote/json_lines/line_input.h"

#include <unistd.h>

#include <cerrno>

namespace lockstep::host {

LineInput::Filled LineInput::fill(int descriptor) {
  constexpr std::size_t kPart = std::size_t{1} << 14;
  text_.erase(0, begin_);
  scanned_ -= begin_;
  begin_ = 0;
  const std::size_t size = text_.size();
  text_.resize(size + kPart);
  const ssize_t got = read(descriptor, text_.data() + size, kPart);
  const int error = errno;
  text_.resize(size + static_cast<std::size_t>(got > 0 ? got : 0));
  if (got > 0) return Filled::Some;
  return got < 0 && (error == EAGAIN || error == EINTR) ? Filled::Nothing : Filled::End;
}

bool LineInput::look(std::size_t& place, std::string& line) const {
  const std::size_t begin = begin_ + place;
  const std::size_t end = text_.find('\n', begin);
  if (end == text_.npos) return false;
  line.assign(text_, begin, end - begin);
  place = end + 1 - begin_;
  return true;
}

bool LineInput::next(std::string& line) {
  const std::size_t end = text_.find('\n', scanned_);
  if (end == text_.npos) {
    scanned_ = text_.size();
    return false;
  }
  line.assign(text_, begin_, end - begin_);
  begin_ = scanned_ = end + 1;
  return true;
}

}  // namespace lockstep::host
