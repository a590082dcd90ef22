#include "observers/append_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace lockstep {

AppendFile::AppendFile(const std::string& path) : path_(path) {
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) fail("open");
  buffer_.reserve(2 * kFull);
}

AppendFile::~AppendFile() {
  flush();
  close();
}

void AppendFile::line_done() {
  const bool full = buffer_.size() >= kFull;
  if (full || std::chrono::steady_clock::now() - last_flush_ >= kLongestDelay) flush();
}

void AppendFile::flush() {
  const char* from = buffer_.data();
  const char* const end = from + buffer_.size();
  while (from != end && file_ >= 0) {
    const ssize_t written = ::write(file_, from, static_cast<std::size_t>(end - from));
    if (written >= 0) {
      from += written;
    } else if (errno != EINTR) {
      fail("write");
    }
  }
  buffer_.clear();
  last_flush_ = std::chrono::steady_clock::now();
}

// Nothing is written after an error: a gap in the middle would be worse than a short file.
void AppendFile::fail(const char* what) {
  error_ = fmt::format("cannot {} '{}': {}", what, path_, std::strerror(errno));
  close();
}

void AppendFile::close() {
  if (file_ < 0) return;
  const int file = file_;
  file_ = -1;
  if (::close(file) != 0 && error_.empty()) fail("close");
}

}  // namespace lockstep
