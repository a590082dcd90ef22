// Calls that do not return. Each waits for the word of the watchdog, not for a time.
#include "run/watchdog.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <future>
#include <thread>

#include "run/stop_signals.h"
#include "unit/runtime/forked_child.h"

namespace lockstep::host::test {
namespace {

using namespace std::chrono_literals;

const CallSite& site = CallSite::of({.path = "Main", .id = "Stuck", .plugin = "probe"});

struct Told {
  CallMark::Look call;
  Nanoseconds lasts;
};

TEST_CASE("a call that lasts as long as the limit is reported") {
  std::promise<Told> promise;
  const Watchdog watchdog(
      {.hang_limit = 100ms, .on_hang = [&](auto... told) { promise.set_value({told...}); }});
  const MarkedCall call(site, PluginFunction::Create);
  const Told told = promise.get_future().get();
  CHECK(told.call.site == &site);
  CHECK(told.call.function == PluginFunction::Create);
  CHECK(told.call == CallMark::this_thread().look());
  CHECK(told.lasts >= 100ms);
}

TEST_CASE("a halt that lasts is reported once, and long before it counts as a hang") {
  std::atomic<int> halts{0}, hangs{0};
  const Watchdog watchdog({.hang_limit = 300ms,
                           .halt_limit = 50ms,
                           .on_long_halt =
                               [&](const auto& call, Nanoseconds lasts) {
                                 const bool before_hang = hangs == halts;
                                 if (call.site == &site && lasts >= 50ms && before_hang) ++halts;
                               },
                           .on_hang =
                               [&](const auto&, Nanoseconds) {
                                 ++hangs;
                                 hangs.notify_one();
                               }});
  for (int round = 0; round < 2; ++round) {
    const MarkedCall call(site, PluginFunction::Halt);
    hangs.wait(round);
    CHECK(halts == round + 1);
  }
  CHECK(hangs == 2);
}

TEST_CASE("only a halt has the limit of a halt") {
  std::atomic<int> halts{0};
  std::promise<void> hung;
  const Watchdog watchdog({.hang_limit = 150ms,
                           .halt_limit = 10ms,
                           .on_long_halt = [&](const auto&, Nanoseconds) { ++halts; },
                           .on_hang = [&](const auto&, Nanoseconds) { hung.set_value(); }});
  const MarkedCall call(site, PluginFunction::Tick);
  hung.get_future().get();
  CHECK(halts == 0);
}

TEST_CASE("many short calls are no long one, and what lies between calls is none") {
  std::atomic<int> hangs{0};
  const Watchdog watchdog({.hang_limit = 80ms, .on_hang = [&](auto&&...) { ++hangs; }});
  WallClock clock;
  for (const Nanoseconds end = clock.now() + 200ms; clock.now() < end;) {
    const MarkedCall call(site, PluginFunction::Tick);
  }
  // Until another watchdog has seen a call of another thread for as long as this one sees none.
  std::thread([] {
    std::promise<void> hung;
    const Watchdog other({.hang_limit = 160ms, .on_hang = [&](auto&&...) { hung.set_value(); }});
    const MarkedCall call(site, PluginFunction::Tick);
    hung.get_future().get();
  }).join();
  CHECK(hangs == 0);
}

TEST_CASE("a stop signal is taken, though the tick thread blocks all signals") {
  const Ended ended = in_child([] {
    StopSignals::install();
    sigset_t all;
    sigfillset(&all);
    sigdelset(&all, SIGALRM);  // which ends a child that waits in vain
    pthread_sigmask(SIG_SETMASK, &all, nullptr);
    const Watchdog watchdog({});
    kill(getpid(), SIGTERM);
    while (StopSignals::received() == 0) std::this_thread::yield();
    _exit(StopSignals::received());
  });
  CHECK(ended.exit_code == SIGTERM);
}

TEST_CASE("the thread that starts a watchdog keeps its signal mask") {
  sigset_t before, after;
  pthread_sigmask(SIG_SETMASK, nullptr, &before);
  const Watchdog watchdog({});
  pthread_sigmask(SIG_SETMASK, nullptr, &after);
  for (const int number : {SIGINT, SIGTERM, SIGUSR1, SIGCHLD}) {
    CHECK(sigismember(&before, number) == sigismember(&after, number));
  }
}

}  // namespace
}  // namespace lockstep::host::test
