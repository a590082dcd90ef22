// A terminal whose program is stopped while it takes it.
#include "terminal/raw_terminal.h"

#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "core/own_thread.h"

namespace lockstep {
namespace {

// Takes the terminal whenever it may, and is stopped by Ctrl-Z.
[[noreturn]] void draw_for_ever(int terminal) {
  static_cast<void>(setpgid(0, 0));  // as a shell does: who has no parent elsewhere is not stopped
  alarm(60);
  RawTerminal raw(terminal, terminal);
  const std::thread thread = own_thread([&raw] {
    while (true) static_cast<void>(raw.take());
  });
  while (true) pause();
}

bool is_raw(int terminal) {
  termios now{};
  REQUIRE(tcgetattr(terminal, &now) == 0);
  return (now.c_lflag & ICANON) == 0;
}

}  // namespace

TEST_CASE("raw terminal: whoever stops the program has the terminal as it was") {
  int master = -1, terminal = -1;
  REQUIRE(openpty(&master, &terminal, nullptr, nullptr, nullptr) == 0);
  const pid_t program = fork();
  if (program == 0) draw_for_ever(terminal);
  while (!is_raw(terminal)) continue;
  int raw = 0;
  for (int stop = 0; stop < 300; ++stop) {
    int status = 0;
    kill(program, SIGTSTP);
    REQUIRE(waitpid(program, &status, WUNTRACED) == program);
    REQUIRE(WIFSTOPPED(status));
    raw += is_raw(terminal);
    tcflush(master, TCIFLUSH);  // what moves the cursor
    kill(program, SIGCONT);
  }
  CHECK(raw == 0);
  kill(program, SIGKILL);
  waitpid(program, nullptr, 0);
  close(terminal);
  close(master);
}

}  // namespace lockstep
