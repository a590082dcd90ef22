// A terminal whose program is stopped while it takes it.
#include "base/terminal/raw_terminal.h"

#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "base/system/own_thread.h"

namespace lockstep::host {
namespace {

void end_with_last_words(int) {
  RawTerminal::restore_for_good();
  usleep(2000);  // what else there is to do before the end
  _exit(0);
}

// Takes the terminal whenever it may, is stopped by Ctrl-Z, and ends by SIGTERM.
[[maybe_unused]] [[noreturn]] void draw_for_ever(int terminal) {
  signal(SIGTERM, end_with_last_words);
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

#if !defined(__SANITIZE_THREAD__)  // which delivers signals later, or never

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

TEST_CASE("raw terminal: a program that ends leaves the terminal as it was, whoever draws still") {
  int master = -1, terminal = -1;
  REQUIRE(openpty(&master, &terminal, nullptr, nullptr, nullptr) == 0);
  for (int end = 0; end < 20; ++end) {
    const pid_t program = fork();
    if (program == 0) draw_for_ever(terminal);
    while (!is_raw(terminal)) continue;
    kill(program, SIGTERM);
    int status = 0;
    waitpid(program, &status, 0);
    CHECK(WIFEXITED(status));
    CHECK_FALSE(is_raw(terminal));
    tcflush(master, TCIFLUSH);
  }
  close(terminal);
  close(master);
}

#endif

// A shell's "fg" continues also what runs.
TEST_CASE("raw terminal: a program that is continued and ends leaves the terminal as it was") {
  int master = -1, terminal = -1;
  REQUIRE(openpty(&master, &terminal, nullptr, nullptr, nullptr) == 0);
  const pid_t program = fork();
  if (program == 0) {
    RawTerminal raw(terminal, terminal);
    if (raw.take() != RawTerminal::State::Taken || !is_raw(terminal)) _exit(1);
    raise(SIGCONT);
    RawTerminal::restore_for_good();
    _exit(is_raw(terminal) ? 2 : 0);
  }
  int status = 0;
  waitpid(program, &status, 0);
  CHECK(status == 0);
  CHECK_FALSE(is_raw(terminal));
  close(terminal);
  close(master);
}

}  // namespace lockstep::host
