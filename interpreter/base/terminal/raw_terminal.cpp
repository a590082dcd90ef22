#include "base/terminal/raw_terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <ctime>
#include <utility>

#include "base/system/signal_mask.h"
#include "base/terminal/screen.h"

namespace lockstep::host {
namespace {

// A process has one terminal, and a signal handler cannot ask an object.
termios g_before{};
int g_keys = -1, g_screen = -1;
int g_typed = -1;                        // reads g_keys, and never waits
std::atomic<bool> g_is_taken{false};     // its modes and its cursor may be ours
std::atomic<bool> g_was_another{false};  // others may have used it since
std::atomic<bool> g_is_being_taken{false};
std::atomic<bool> g_is_stopping{false};  // by Ctrl-Z
std::atomic<bool> g_is_ending{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void restore();

// Stops the process as it would be stopped without us; returns when it goes on.
void on_stop(int number) {
  const int error = errno;
  g_is_stopping = true;
  restore();
  struct sigaction standard {};
  struct sigaction before {};
  standard.sa_handler = SIG_DFL;
  sigaction(number, &standard, &before);
  raise(number);
  unblock(signal_set({number}));  // here it stops
  sigaction(number, &before, nullptr);
  g_is_stopping = false;
  errno = error;
}

// After SIGSTOP, which nobody can handle, the terminal may have been the shell's. Or not: a shell
// also continues what runs.
void on_continue(int) {
  g_was_another = true;
}

void handle(int number, void (*handler)(int)) {
  struct sigaction now {};
  sigaction(number, nullptr, &now);
  if (now.sa_handler != SIG_DFL) return;
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(number, &action, nullptr);
}

void leave(int number, void (*handler)(int)) {
  struct sigaction now {};
  sigaction(number, nullptr, &now);
  if (now.sa_handler == handler) signal(number, SIG_DFL);
}

// A terminal that is not the process's own has no foreground, and may be drawn on.
bool is_in_foreground() {
  const pid_t foreground = tcgetpgrp(g_keys >= 0 ? g_keys : g_screen);
  return foreground < 0 || foreground == getpgrp();
}

void make_raw() {
  termios raw = g_before;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | IEXTEN);
  raw.c_cc[VMIN] = 1;
  raw.c_cc[VTIME] = 0;
  tcsetattr(g_keys, TCSANOW, &raw);
}

// The time in which the terminal is taken: who gives it back waits for its end. No signal handler
// runs in this thread then, which would wait for itself.
class Taking {
 public:
  Taking() { g_is_being_taken = true; }
  ~Taking() { g_is_being_taken = false; }
  Taking(const Taking&) = delete;
  Taking& operator=(const Taking&) = delete;

  // Not for ever: a terminal may be stuck.
  static void wait_for_end() {
    constexpr timespec kNap{.tv_sec = 0, .tv_nsec = 100'000};
    for (int nap = 0; g_is_being_taken && nap < 1000; ++nap) nanosleep(&kNap, nullptr);
  }

 private:
  // SIGTTOU, if it were blocked, would let the background set the terminal.
  const SignalMask mask_{SIG_BLOCK, all_signals_but({SIGTTOU})};
};

void restore() {
  Taking::wait_for_end();
  if (!g_is_taken.exchange(false) || !is_in_foreground()) return;
  if (g_keys >= 0) tcsetattr(g_keys, TCSANOW, &g_before);
  show_cursor(g_screen);
}

bool is_away() {
  return g_is_stopping || g_is_ending || !is_in_foreground();
}

// A shell may take a key between our poll and our read, which then must not wait. O_NONBLOCK is set
// on a file of ours: the one we were given is the shell's too.
int open_typed(int keys) {
  if (keys < 0 || tcgetsid(keys) != getsid(0)) return -1;
  return open("/dev/tty", O_RDONLY | O_NONBLOCK | O_CLOEXEC);
}

}  // namespace

RawTerminal::RawTerminal(int keys, int screen) {
  if (keys >= 0) tcgetattr(keys, &g_before);
  g_keys = keys;
  g_typed = open_typed(keys);
  g_screen = screen;
  handle(SIGTSTP, on_stop);
  handle(SIGCONT, on_continue);
}

RawTerminal::~RawTerminal() {
  restore();
  leave(SIGTSTP, on_stop);
  leave(SIGCONT, on_continue);
  if (g_typed >= 0) close(std::exchange(g_typed, -1));
}

RawTerminal::State RawTerminal::take() {
  if (!is_in_foreground()) g_was_another = true;
  if (is_away()) return State::Away;
  if (g_is_taken && !g_was_another) return State::Kept;
  const Taking taking;
  if (is_away()) return State::Away;
  g_was_another = false;
  g_is_taken = true;  // before it is, so that whatever happens from here on restores it
  if (g_keys >= 0) make_raw();
  hide_cursor(g_screen);
  return State::Taken;
}

// A process that went into the background after the poll that saw a key may not read: EIO. Whether
// the terminal is gone, only poll says.
std::optional<std::string> RawTerminal::read_keys() {
  if (is_away()) return "";
  char bytes[64];
  const ssize_t count = read(g_typed >= 0 ? g_typed : g_keys, bytes, sizeof bytes);
  if (count > 0) return std::string(bytes, static_cast<std::size_t>(count));
  pollfd keys{g_keys, POLLIN, 0};
  if (poll(&keys, 1, 0) > 0 && (keys.revents & ~POLLIN) != 0) return std::nullopt;
  return "";
}

void RawTerminal::restore_for_good() {
  g_is_ending = true;
  restore();
}

}  // namespace lockstep::host
