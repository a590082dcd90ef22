// A file that only grows: text is collected and written with write(2) in whole pieces, so that what
// was written before a kill can be read. The first error is kept and ends the writing.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace lockstep {

class AppendFile {
 public:
  static constexpr std::size_t kFull = 64 * 1024;
  static constexpr std::chrono::milliseconds kLongestDelay{100};

  // Creates the file, or empties it; `error()` tells when that is not possible.
  explicit AppendFile(const std::string& path);
  // Flushes.
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  // Append whole lines here, then call line_done().
  fmt::memory_buffer& buffer() { return buffer_; }
  // Writes what is collected when there is enough of it or when it is old enough (real time).
  void line_done();
  void flush();

  // "" while all is well, else "cannot write 'x': No space left on device".
  const std::string& error() const { return error_; }

 private:
  void fail(const char* what);
  void close();

  std::string path_;
  std::string error_;
  int file_ = -1;
  fmt::memory_buffer buffer_;
  std::chrono::steady_clock::time_point last_flush_ = std::chrono::steady_clock::now();
};

}  // namespace lockstep
