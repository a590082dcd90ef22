#include "base/system/descriptors.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>

namespace lockstep::host {

void hold_standard_descriptors() noexcept {
  // The wrong way around for stdin and stdout: who needs them must see that they are missing.
  constexpr int kModes[] = {O_WRONLY, O_RDONLY, O_WRONLY};
  for (int file = STDIN_FILENO; file <= STDERR_FILENO; ++file) {
    // open() returns the lowest number that is free, which is this one.
    if (fcntl(file, F_GETFD) < 0) static_cast<void>(open("/dev/null", kModes[file]));
  }
}

void make_writes_fail() noexcept {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

bool write_all(int file, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t count = write(file, text.data(), text.size());
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool write_all(int file, std::string_view text, bool (*gives_up)()) noexcept {
  constexpr int kLook =
      100;  // milliseconds; a signal may come before the wait, or to another thread
  while (!text.empty()) {
    pollfd reader{file, POLLOUT, 0};
    const auto would_wait = [&reader] {
      const int ready = poll(&reader, 1, 0);
      return ready == 0 || (ready < 0 && errno == EINTR);  // also without a wait
    };
    while (would_wait()) {
      if (gives_up()) {
        errno = EINTR;
        return false;
      }
      poll(&reader, 1, kLook);
    }
    // So much does not wait.
    const std::string_view part = text.substr(0, PIPE_BUF);
    if (!write_all(file, part)) return false;
    text.remove_prefix(part.size());
  }
  return true;
}

void write_now(int file, std::string_view text) noexcept {
  while (!text.empty()) {
    pollfd reader{file, POLLOUT, 0};
    if (poll(&reader, 1, 0) != 1 || (reader.revents & POLLOUT) == 0) return;
    // A pipe that can be written to takes so many bytes without waiting.
    const ssize_t count = write(file, text.data(), std::min<std::size_t>(text.size(), PIPE_BUF));
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace lockstep::host
