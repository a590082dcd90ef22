// The rate of the loop on a clock that is real to it, while the test says how time passes: in the
// ticks of leaves by a plan, and beyond deadlines by the latency of waking up.
#include "run/loop.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <new>
#include <random>
#include <stdexcept>

#include "base/system/own_thread.h"
#include "unit/runtime/forked_child.h"
#include "unit/runtime/timed_leaf.h"

namespace lockstep::host::test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using Random = std::mt19937_64;

Nanoseconds uniform(Random& random, Nanoseconds most) {
  return Nanoseconds(std::uniform_int_distribution<std::int64_t>(0, most.count())(random));
}

class TestClock final : public Clock {
 public:
  Nanoseconds now() override { return now_; }
  void sleep_until(Nanoseconds deadline) override {
    if (deadline > now_) now_ = deadline + uniform(random_, latency);
  }
  bool is_real() const override { return true; }
  void pass(Nanoseconds time) { now_ += time; }

  Nanoseconds latency{0};  // the most of it

 private:
  Nanoseconds now_ = std::chrono::hours(100);  // since the computer was switched on
  Random random_{1};
};

struct Begin {
  Nanoseconds time;
  std::uint64_t skipped;
};

// When each tick began, as the loop says.
class Begins final : public Observer {
 public:
  void after_tick(const Moment&, const TickReport& report) override {
    list.push_back({report.time, report.skipped});
  }
  void run_ended(const Moment&, const RunEnd&) override { ended = true; }
  std::vector<Begin> list;
  bool ended = false;
};

// A run of `leaves` leaves on a TestClock.
struct Fixture {
  explicit Fixture(std::uint32_t leaves = 1) : timed(leaves) {}

  RunEnd run(const LoopOptions& options, LeafWatch* watch = nullptr) {
    RunOptions run_options;
    run_options.watch = watch;
    Run it(timed.tree, run_options);
    Observer* const observers[] = {&begins};
    return run_loop(it, clock, options, observers);
  }

  TimedLeaves timed;
  TestClock clock;
  Begins begins;
};

// Deadline k of a whole rate, without floating point: k / rate seconds, rounded to the nanosecond.
Nanoseconds due(std::uint64_t k, std::uint64_t rate) {
  return Nanoseconds((2 * k * 1'000'000'000 + rate) / (2 * rate));
}

// How long each tick takes: mostly little, at times several periods.
std::vector<Nanoseconds> plan_of_delays(std::size_t ticks, Nanoseconds period, std::uint64_t seed) {
  Random random(seed);
  std::vector<Nanoseconds> delays;
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    const auto most = random() % 10 == 0 ? 5 * period : period / 2;
    delays.push_back(random() % 50 == 0 ? 3 * period : uniform(random, most));
  }
  return delays;
}

int stop = 0;
int stop_signal() {
  return stop;
}

LoopOptions options_at(std::uint64_t rate, std::uint64_t ticks, OverrunPolicy overrun) {
  LoopOptions options;
  options.rate = static_cast<double>(rate);
  options.max_ticks = ticks;
  options.overrun = overrun;
  return options;
}

constexpr std::uint64_t kMillion = 1'000'000;

}  // namespace

TEST_CASE("a million ticks in time keep the rate to a billionth") {
  const std::uint64_t rate = GENERATE(100, 1000, 3, 300, 7);
  CAPTURE(rate);
  Fixture fixture;
  const RunEnd end = fixture.run(options_at(rate, kMillion, OverrunPolicy::Skip));
  const auto& begins = fixture.begins.list;
  REQUIRE(begins.size() == kMillion);
  const double mean = to_seconds(begins.back().time - begins.front().time) / (kMillion - 1);
  CHECK(std::abs(mean * static_cast<double>(rate) - 1) < 1e-9);
  CHECK(end.overruns == 0);
  CHECK(end.skipped == 0);
}

TEST_CASE("over a million ticks with latency none begins early and none later than the latency") {
  const std::uint64_t rate = GENERATE(100, 1000, 3, 300);
  CAPTURE(rate);
  Fixture fixture;
  fixture.clock.latency = microseconds(200);
  TimedLeaves::on_tick = [&](std::uint32_t) { fixture.clock.pass(microseconds(100)); };
  const RunEnd end = fixture.run(options_at(rate, kMillion, OverrunPolicy::Skip));
  REQUIRE(fixture.begins.list.size() == kMillion);
  std::uint64_t wrong = 0;
  for (std::uint64_t tick = 0; tick < kMillion; ++tick) {
    const Nanoseconds late = fixture.begins.list[tick].time - due(tick, rate);
    wrong += late < Nanoseconds(0) || late > fixture.clock.latency;
  }
  CHECK(wrong == 0);
  CHECK(end.overruns == 0);
}

TEST_CASE("skip: late ticks cost the deadlines that the plan of delays says, and nothing else") {
  const std::uint64_t rate = GENERATE(100, 1000, 3, 300);
  CAPTURE(rate);
  constexpr std::size_t kTicks = 20000;
  const Nanoseconds period = due(1, rate);
  const auto delays = plan_of_delays(kTicks, period, rate);
  Fixture fixture;
  fixture.clock.latency = period / 20;
  std::size_t tick = 0;
  TimedLeaves::on_tick = [&](std::uint32_t) { fixture.clock.pass(delays[tick++]); };
  const RunEnd end = fixture.run(options_at(rate, kTicks, OverrunPolicy::Skip));

  const auto& begins = fixture.begins.list;
  REQUIRE(begins.size() == kTicks);
  std::uint64_t deadline = 0, overruns = 0, skipped = 0, wrong = 0, skipped_before = 0;
  for (std::size_t k = 0; k < kTicks; ++k) {
    const Nanoseconds late = begins[k].time - due(deadline, rate);
    wrong += late < Nanoseconds(0) || late > fixture.clock.latency;
    wrong += begins[k].skipped != skipped_before;
    const Nanoseconds ended = begins[k].time + delays[k];
    ++deadline;
    skipped_before = 0;
    overruns += due(deadline, rate) < ended;
    for (; due(deadline, rate) < ended; ++deadline) ++skipped_before;
    skipped += skipped_before;
  }
  CHECK(wrong == 0);
  CHECK(overruns > 0);
  CHECK(end.overruns == overruns);
  CHECK(end.skipped == skipped);
  CHECK(end.ticks + end.skipped == deadline);  // the periods that have passed
}

TEST_CASE("a tick that ends just at the next deadline is not late") {
  Fixture fixture;
  TimedLeaves::on_tick = [&](std::uint32_t) { fixture.clock.pass(milliseconds(10)); };
  CHECK(fixture.run(options_at(100, 5, OverrunPolicy::Skip)).overruns == 0);
  CHECK(fixture.begins.list.back().time == milliseconds(40));
}

TEST_CASE("catch-up: every deadline gets its tick, none before it is due, and no time is lost") {
  const std::uint64_t rate = GENERATE(100, 1000, 3, 300);
  CAPTURE(rate);
  constexpr std::size_t kTicks = 20000;
  const auto delays = plan_of_delays(kTicks - 1000, due(1, rate), rate);
  Fixture fixture;
  std::size_t tick = 0;
  TimedLeaves::on_tick = [&](std::uint32_t) {
    if (tick < delays.size()) fixture.clock.pass(delays[tick++]);  // then it can catch up
  };
  LoopOptions options = options_at(rate, kTicks * 2, OverrunPolicy::CatchUp);
  options.timeout = due(kTicks, rate);
  const RunEnd end = fixture.run(options);

  CHECK(end.reason == StopReason::Timeout);
  CHECK(end.ticks == kTicks);
  CHECK(end.skipped == 0);
  std::uint64_t wrong = 0, overruns = 0;
  Nanoseconds ended{0};
  for (std::size_t k = 0; k < fixture.begins.list.size(); ++k) {
    wrong += fixture.begins.list[k].time != std::max(due(k, rate), ended);
    wrong += fixture.begins.list[k].skipped != 0;
    ended = fixture.begins.list[k].time + (k < delays.size() ? delays[k] : Nanoseconds(0));
    overruns += ended > due(k + 1, rate);
  }
  CHECK(wrong == 0);
  CHECK(overruns > 0);
  CHECK(end.overruns == overruns);
}

TEST_CASE("catch-up: a stop signal and a limit of ticks end a burst") {
  Fixture fixture;
  std::uint64_t ticks = 0;
  stop = 0;
  LoopOptions options = options_at(100, 8, OverrunPolicy::CatchUp);
  options.stop_signal = stop_signal;
  SECTION("a stop signal") {
    TimedLeaves::on_tick = [&](std::uint32_t) {
      if (++ticks == 1) fixture.clock.pass(milliseconds(500));
      if (ticks == 5) stop = 15;
    };
    const RunEnd end = fixture.run(options);
    CHECK(end.reason == StopReason::Signal);
    CHECK(end.signal == 15);
    CHECK(end.ticks == 5);
  }
  SECTION("a limit of ticks") {
    TimedLeaves::on_tick = [&](std::uint32_t) {
      if (++ticks == 1) fixture.clock.pass(milliseconds(500));
    };
    const RunEnd end = fixture.run(options);
    CHECK(end.reason == StopReason::MaxTicks);
    CHECK(end.ticks == 8);
  }
  CHECK(fixture.begins.list.back().time == milliseconds(500));
  stop = 0;
}

TEST_CASE("a stop that is asked for once is kept, in whichever call") {
  for (int at = 1; at <= 8; ++at) {
    Fixture fixture;
    int calls = 0;
    LoopOptions options = options_at(100, 20, OverrunPolicy::Skip);
    options.stop_signal = [&] { return ++calls == at ? 15 : 0; };
    const RunEnd end = fixture.run(options);
    INFO(at);
    CHECK(end.reason == StopReason::Signal);
    CHECK(end.signal == 15);
    CHECK(calls == at);
  }
}

TEST_CASE("fail: the run ends in order after its first late tick") {
  Fixture fixture(3);
  std::uint64_t ticks = 0;
  TimedLeaves::on_tick = [&](std::uint32_t leaf) {
    if (leaf == 0 && ++ticks == 7) fixture.clock.pass(milliseconds(10) + Nanoseconds(1));
  };
  const RunEnd end = fixture.run(options_at(100, 1000, OverrunPolicy::Fail));
  CHECK(end.reason == StopReason::Overrun);
  CHECK(end.ticks == 7);
  CHECK(end.overruns == 1);
  CHECK(end.skipped == 0);
  CHECK(TimedLeaves::halted == 3);
  CHECK(fixture.begins.ended);
}

TEST_CASE("the worst tick is the longest one") {
  constexpr std::size_t kTicks = 1000;
  const auto delays = plan_of_delays(kTicks, milliseconds(10), 5);
  Fixture fixture;
  std::size_t tick = 0;
  TimedLeaves::on_tick = [&](std::uint32_t) { fixture.clock.pass(delays[tick++]); };
  const RunEnd end = fixture.run(options_at(100, kTicks, OverrunPolicy::Skip));
  const auto worst = std::ranges::max_element(delays);
  CHECK(end.worst.took == *worst);
  CHECK(end.worst.tick == static_cast<std::uint64_t>(worst - delays.begin()));
  CHECK_FALSE(end.worst.leaf.has_value());  // nobody timed the calls
}

TEST_CASE("the worst tick names the leaf that took at least half of it") {
  const auto [first, second, named] = GENERATE(
      table<int, int, std::optional<NodeIndex>>({{2, 5, 2}, {5, 2, 1}, {3, 4, std::nullopt}}));
  CAPTURE(first, second);
  Fixture fixture(3);
  std::uint64_t ticks = 0;
  TimedLeaves::on_tick = [&, first = first, second = second](std::uint32_t leaf) {
    if (leaf == 0) ++ticks;
    const int factor = ticks == 4 ? 1000 : 1;
    fixture.clock.pass(factor * microseconds(leaf == 0 ? first : leaf == 1 ? second : 2));
  };
  LeafWatchOptions watched;
  watched.budget = milliseconds(10);
  watched.clock = &fixture.clock;
  LeafWatch watch(watched);
  const RunEnd end = fixture.run(options_at(100, 10, OverrunPolicy::Skip), &watch);
  CHECK(end.worst.tick == 3);
  CHECK(end.worst.took == milliseconds(first + second + 2));
  CHECK(end.worst.leaf == named);
  CHECK(end.worst.leaf_took == (named ? Nanoseconds(milliseconds(5)) : Nanoseconds(0)));
}

TEST_CASE("a report has the faults that the run goes on after") {
  struct Faults final : Observer {
    void after_tick(const Moment&, const TickReport& report) override {
      for (const Fault& fault : report.faults) {
        told.push_back(std::to_string(report.tick) + " " + std::to_string(fault.node) + " " +
                       fault.message);
      }
    }
    std::vector<std::string> told;
  } faults;
  Fixture fixture(2);
  std::uint64_t ticks = 0;
  TimedLeaves::on_tick = [&](std::uint32_t leaf) {
    if (leaf == 1 && ++ticks == 3) throw std::runtime_error("no arm");
  };
  RunOptions run_options;
  run_options.on_fault = FaultPolicy::Fail;
  Run run(fixture.timed.tree, run_options);
  Observer* const observers[] = {&faults};
  const RunEnd end =
      run_loop(run, fixture.clock, options_at(100, 10, OverrunPolicy::Skip), observers);
  CHECK(end.reason == StopReason::Completed);
  CHECK(end.status == Status::Failure);
  CHECK(faults.told == std::vector<std::string>{"2 2 threw an exception: no arm"});
}

TEST_CASE("on a virtual clock nothing is late and no tick is the worst") {
  Fixture fixture;
  VirtualClock clock;
  Run run(fixture.timed.tree, {});
  const RunEnd end = run_loop(run, clock, options_at(100, 10, OverrunPolicy::Fail), {});
  CHECK(end.reason == StopReason::MaxTicks);
  CHECK(end.overruns == 0);
  CHECK(end.worst.took == Nanoseconds(0));
}

TEST_CASE("a run ends before its time is too long for 64 bits") {
  Fixture fixture;
  VirtualClock clock;
  LoopOptions options = options_at(1, 20'000, OverrunPolicy::Fail);
  options.rate = 1e-6;
  Run run(fixture.timed.tree, {.rate = options.rate});
  const RunEnd end = run_loop(run, clock, options, {});
  CHECK(end.reason == StopReason::Timeout);
  // A second of doubles at this size.
  CHECK(std::abs(to_seconds(end.time - kLongestRun)) < 1);
}

TEST_CASE("an exception that nobody expected halts the running leaves on its way") {
  struct Throwing final : Observer {
    void after_tick(const Moment&, const TickReport& report) override {
      if (report.tick == 3) throw std::bad_alloc();
    }
  } throwing;
  Fixture fixture(3);
  Observer* const observers[] = {&throwing};
  const auto run_it = [&] {
    Run run(fixture.timed.tree, {});
    run_loop(run, fixture.clock, options_at(100, 10, OverrunPolicy::Skip), observers);
  };
  CHECK_THROWS_AS(run_it(), std::bad_alloc);
  CHECK(TimedLeaves::halted == 3);
}

TEST_CASE("an exception in another thread of ours ends the run at its next tick") {
  const Ended ended = in_child([] {
    Fixture fixture(3);
    TimedLeaves::on_tick = [](std::uint32_t leaf) {
      if (leaf == 2) own_thread([] { throw std::runtime_error("unexpected"); }).join();
    };
    try {
      fixture.run(options_at(100, 10, OverrunPolicy::Skip));
    } catch (const std::runtime_error& error) {
      const bool good = error.what() == std::string("unexpected") && TimedLeaves::halted == 3;
      _exit(good ? 42 : 1);
    }
  });
  CHECK(ended.exit_code == 42);
}

}  // namespace lockstep::host::test
