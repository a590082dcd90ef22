#include "base/terminal/terminal_wait.h"

#include <poll.h>

#include <ctime>

namespace lockstep::host {
namespace {

volatile sig_atomic_t g_resized = 0;

void on_resize(int) {
  g_resized = 1;
}

timespec time_of(double seconds) {
  const auto whole = static_cast<std::time_t>(seconds);
  return {.tv_sec = whole,
          .tv_nsec = static_cast<long>((seconds - static_cast<double>(whole)) * 1e9)};
}

}  // namespace

// The signal is let in only while wait() waits.
TerminalWait::TerminalWait(int keys) : keys_(keys) {
  struct sigaction action {};
  action.sa_handler = on_resize;
  sigaction(SIGWINCH, &action, &action_before_);
}

TerminalWait::~TerminalWait() {
  sigaction(SIGWINCH, &action_before_, nullptr);
}

TerminalEvent TerminalWait::wait(double seconds) const {
  pollfd keys{keys_, POLLIN, 0};
  const timespec limit = time_of(seconds);
  const int ready = ppoll(&keys, 1, &limit, &mask_.before());
  if (g_resized != 0) {
    g_resized = 0;
    return TerminalEvent::Resize;
  }
  return ready > 0 ? TerminalEvent::Key : TerminalEvent::None;
}

}  // namespace lockstep::host
