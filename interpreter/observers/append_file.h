// A file that only grows, written by a thread of its own: a slow disk must not delay a tick. Text
// is written with write(2) in pieces of whole lines, so that a file cut by a kill can be read up to
// its last whole line. The first error is kept and ends the writing.
#pragma once

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace lockstep {

class AppendFile {
 public:
  static constexpr std::size_t kFull = 64u << 10;  // bytes
  static constexpr std::chrono::milliseconds kLongestDelay{100};
  // With so much collected, line_done() waits for the disk: memory must end somewhere.
  static constexpr std::size_t kMost = 16u << 20;

  // Creates the file, or empties it; error() tells when that is not possible.
  explicit AppendFile(const std::string& path);
  // Flushes.
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  // Append a whole line here, then call line_done(). One thread at a time.
  fmt::memory_buffer& buffer() { return buffer_; }
  // Hands over what is collected when it is much (kFull) or old (kLongestDelay of real time).
  void line_done();
  // Returns when all is written, or writing has failed.
  void flush();

  // "" while all is well, else "cannot write 'x': No space left on device".
  const std::string& error() const;

 private:
  void hand_over(std::unique_lock<std::mutex>& lock);
  void write_until_stopped();
  void write(const fmt::memory_buffer& text);
  void fail(const char* what);

  std::string path_;
  int file_ = -1;
  fmt::memory_buffer buffer_;
  std::chrono::steady_clock::time_point handed_over_ = std::chrono::steady_clock::now();
  std::string error_;  // not touched any more once failed_
  std::atomic<bool> failed_{false};

  std::mutex mutex_;  // for what follows
  std::condition_variable work_, done_;
  fmt::memory_buffer pending_;  // handed over, not yet taken by the thread
  bool writing_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace lockstep
