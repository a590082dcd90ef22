// A disk that takes no more: a named pipe of one page that nobody reads, until somebody does.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <thread>

#include "unit/recording/watched_run.h"

namespace lockstep::host::test {

class BlockedDisk {
 public:
  static constexpr int kPage = 4096;

  BlockedDisk() {
    ::mkfifo(path().c_str(), 0600);
    pipe_ = ::open(path().c_str(), O_RDONLY | O_NONBLOCK);
    ::fcntl(pipe_, F_SETPIPE_SZ, kPage);
  }
  ~BlockedDisk() {
    if (reader_.joinable()) reader_.join();
    close();
  }
  BlockedDisk(const BlockedDisk&) = delete;
  BlockedDisk& operator=(const BlockedDisk&) = delete;

  const std::string& path() const { return path_.path(); }
  // Takes everything from now on, until the writer closes the file.
  void unblock() {
    ::fcntl(pipe_, F_SETFL, 0);
    reader_ = std::thread([this] { read_all(); });
  }
  // What it took. Close the writer first.
  const std::string& text() {
    reader_.join();
    return text_;
  }
  // Writing to it is an error from now on.
  void close() {
    if (pipe_ >= 0) ::close(pipe_);
    pipe_ = -1;
  }

 private:
  void read_all() {
    char bytes[kPage];
    // A pipe that no writer has opened yet would be at its end.
    pollfd writer{pipe_, POLLIN, 0};
    ::poll(&writer, 1, -1);
    while (true) {
      const ssize_t count = ::read(pipe_, bytes, sizeof bytes);
      if (count <= 0) return;
      text_.append(bytes, static_cast<std::size_t>(count));
    }
  }

  TemporaryPath path_;
  int pipe_ = -1;
  std::thread reader_;
  std::string text_;
};

}  // namespace lockstep::host::test
