#include "observers/raw_terminal.h"

#include <signal.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>

#include "observers/screen.h"

namespace lockstep {
namespace {

// Of the one terminal that a process has; a signal handler cannot ask an object.
termios g_before{};
int g_keys = -1, g_screen = -1;
std::atomic<bool> g_is_raw{false};
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr int kFatalSignals[] = {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

void on_fatal_signal(int number) {
  RawTerminal::restore();
  signal(number, SIG_DFL);
  raise(number);
}

void set(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  for (const int number : kFatalSignals) sigaction(number, &action, nullptr);
}

void make_raw() {
  termios raw = g_before;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO | IEXTEN);
  raw.c_cc[VMIN] = 1;
  raw.c_cc[VTIME] = 0;
  // As keys: a process that these stop or end would leave the terminal raw.
  raw.c_cc[VSUSP] = raw.c_cc[VQUIT] = _POSIX_VDISABLE;
  g_is_raw = true;
  tcsetattr(g_keys, TCSANOW, &raw);
}

}  // namespace

RawTerminal::RawTerminal(int keys, int screen) {
  tcgetattr(keys, &g_before);
  g_keys = keys;
  g_screen = screen;
  set(on_fatal_signal);
  make_raw();
}

RawTerminal::~RawTerminal() {
  restore();
  set(SIG_DFL);
}

void RawTerminal::suspend() {
  restore();
  raise(SIGTSTP);
  make_raw();
}

void RawTerminal::restore() {
  if (!g_is_raw.exchange(false)) return;
  tcsetattr(g_keys, TCSANOW, &g_before);
  restore_cursor(g_screen);
}

}  // namespace lockstep
