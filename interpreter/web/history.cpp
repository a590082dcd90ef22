#include "web/history.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>

#include "core/file_descriptor.h"

namespace lockstep {
namespace {

// Nothing but a file: a pipe would take what is for its reader.
std::FILE* open_regular(const std::string& path) {
  if (path.empty()) return nullptr;
  FileDescriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (file.number() < 0 || fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) {
    return nullptr;
  }
  return fdopen(dup(file.number()), "r");
}

}  // namespace

History::History(const LineLog& log, const std::string& recording)
    : log_(log), file_(open_regular(recording)), event_(log.first()) {
  const auto full = log.last_full();
  if (!full) file_.reset();
  if (file_ == nullptr) return;
  event_ = *full;
  until_ = *log.tick(event_);
}

WebStream::Piece History::read(std::span<char> to) {
  // The log may have dropped the line meanwhile.
  if (read_ != 0 && read_ - 1 < log_.first()) return {Piece::What::End};
  if (rest_.empty()) rest_ = next();
  if (rest_.empty()) return {Piece::What::End};
  const std::size_t count = rest_.copy(to.data(), to.size());
  rest_.remove_prefix(count);
  return {Piece::What::Bytes, count};
}

std::string_view History::next() {
  if (file_ != nullptr) {
    const std::string_view line = next_recorded();
    if (!line.empty()) return line;
    file_.reset();
  } else if (is_at_header_) {
    is_at_header_ = false;
    return log_.header_line();
  }
  return next_logged();
}

// The last line may be half written.
std::string_view History::next_recorded() {
  line_.clear();
  for (int letter = 0; !line_.ends_with('\n'); line_ += static_cast<char>(letter)) {
    letter = getc_unlocked(file_.get());
    if (letter == EOF) return {};
  }
  is_at_header_ = false;
  const auto tick = tick_of_line(line_);
  const bool is_end = line_.starts_with("{\"end\"");
  return is_end || (tick && *tick >= until_) ? std::string_view() : line_;
}

std::string_view History::next_logged() {
  if (event_ < log_.first()) return {};
  while (event_ < log_.end()) {
    read_ = event_ + 1;
    const std::string_view line = log_.line(event_++);
    if (!line.empty()) return line;
  }
  return {};
}

}  // namespace lockstep
