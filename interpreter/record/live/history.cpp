#include "record/live/history.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

#include "base/system/file_descriptor.h"
#include "record/json_lines.h"

namespace lockstep::host {
namespace {

// Nothing but a file of lines: a pipe would take what is for its reader, and what is compressed, or
// MCAP, is nothing for a client that reads lines. It gets what the log still has.
std::FILE* open_regular(const std::string& path) {
  if (path.empty()) return nullptr;
  FileDescriptor file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (file.number() < 0 || fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) {
    return nullptr;
  }
  char first = '{';
  if (pread(file.number(), &first, 1, 0) == 1 && first != '{') return nullptr;
  return fdopen(fcntl(file.number(), F_DUPFD_CLOEXEC, 0), "r");
}

}  // namespace

History::History(const LineLog& log, const std::string& recording, bool is_coming)
    : log_(log),
      file_(open_regular(recording)),
      full_(log.last_full()),
      asked_(monotonic_now()),
      waits_(is_coming && file_ != nullptr),
      event_(log.first()) {
  if (!waits_) is_seam_there();
}

// Where the recording ends and the log begins. Until a tick comes the client waits, but not for
// long.
bool History::is_seam_there() {
  const auto full = log_.last_full();
  if (waits_ && full == full_ && monotonic_now() - asked_ < kPatience) return false;
  waits_ = false;
  if (!full) file_.reset();
  if (file_ == nullptr) return true;
  event_ = *full;
  until_ = *log_.tick(event_);
  return true;
}

Stream::Piece History::read(std::span<char> to) {
  if (waits_ && !is_seam_there()) return {Piece::What::Wait};
  // The log may have dropped the line meanwhile.
  if (read_ != 0 && read_ - 1 < log_.first()) return {Piece::What::End};
  if (rest_.empty()) {
    const auto line = next();
    if (!line) return {Piece::What::Wait};
    rest_ = *line;
  }
  if (rest_.empty()) return {Piece::What::End};
  const std::size_t count = rest_.copy(to.data(), to.size());
  rest_.remove_prefix(count);
  return {Piece::What::Bytes, count};
}

std::optional<std::string_view> History::next() {
  if (file_ != nullptr) {
    const auto line = next_recorded();
    if (!line || !line->empty()) return line;
    file_.reset();
  }
  if (std::exchange(is_at_header_, false)) return log_.header_line();
  return next_logged();
}

// Nothing: the end of it is still on its way to the disk.
std::optional<std::string_view> History::next_recorded() {
  if (line_.ends_with('\n')) line_.clear();
  while (!line_.ends_with('\n')) {
    const int letter = getc_unlocked(file_.get());
    if (letter == EOF) {
      std::clearerr(file_.get());
      const bool is_late = next_tick_ < until_ && monotonic_now() - asked_ < kPatience;
      return is_late ? std::nullopt : std::optional(std::string_view());
    }
    line_ += static_cast<char>(letter);
  }
  is_at_header_ = false;
  const auto tick = json_lines::tick_of(line_);
  if (tick) next_tick_ = *tick + 1;
  return json_lines::is_last(line_) || (tick && *tick >= until_) ? std::string_view() : line_;
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

}  // namespace lockstep::host
