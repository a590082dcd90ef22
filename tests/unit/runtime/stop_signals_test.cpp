#include "run/stop_signals.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "base/system/fork_guard.h"
#include "unit/runtime/forked_child.h"

namespace lockstep::host::test {
namespace {

void last_line() {
  static_cast<void>(!write(STDERR_FILENO, "last words\n", 11));
}

TEST_CASE("stop signals: the first is noted, and the same again at once is no second one") {
  const Ended ended = in_child([] {
    StopSignals::install(last_line);
    raise(SIGTERM);  // as timeout(1) sends it
    raise(SIGTERM);
    _exit(StopSignals::received());
  });
  CHECK(ended.exit_code == SIGTERM);
  CHECK(ended.said.empty());
}

TEST_CASE("stop signals: a second one of a person ends the process, after its last words") {
  for (const int number : {SIGINT, SIGQUIT, SIGTERM}) {
    const Ended ended = in_child([number] {
      StopSignals::install(last_line);
      raise(SIGHUP);
      raise(SIGUSR1);  // no person's
      raise(number);
    });
    CHECK(ended.exit_code == 128 + number);
    CHECK(ended.said == "last words\n");
  }
}

TEST_CASE("stop signals: last words that get stuck do not keep the process") {
  const Ended ended = in_child([] {
    StopSignals::install([] {
      while (true) pause();
    });
    raise(SIGINT);
    raise(SIGTERM);
  });
  CHECK(ended.exit_code == 128 + SIGTERM);
}

TEST_CASE("stop signals: what a plugin or nohup has chosen stays") {
  const Ended ended = in_child([] {
    signal(SIGHUP, SIG_IGN);
    signal(SIGUSR1, [](int) { _exit(77); });
    StopSignals::install();
    raise(SIGHUP);
    if (StopSignals::received() != 0) _exit(1);
    raise(SIGUSR1);
  });
  CHECK(ended.exit_code == 77);
}

TEST_CASE("stop signals: they end a child that a plugin forks off") {
  const Ended ended = in_child([] {
    ForkGuard::arm([] {});
    StopSignals::install(last_line);
    int status = 0;
    const pid_t child = fork();
    if (child == 0) {
      raise(SIGTERM);
      _exit(0);
    }
    waitpid(child, &status, 0);
    _exit(WIFSIGNALED(status) ? WTERMSIG(status) : 99);
  });
  CHECK(ended.exit_code == SIGTERM);
  CHECK(ended.said.empty());
}

}  // namespace
}  // namespace lockstep::host::test
