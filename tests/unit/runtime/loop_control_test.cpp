// A run that somebody pauses: its time, its deadlines, its leaves, and what still ends it.
#include <catch2/catch.hpp>
#include <functional>

#include "run/loop.h"
#include "run/run_control.h"
#include "support/tree_text.h"
#include "unit/runtime/timed_leaf.h"

namespace lockstep::host::test {
namespace {

using Order = RunControl::Order;
using What = Order::What;
using std::chrono::hours;
using std::chrono::milliseconds;

// Real to the loop; the test lets time pass.
class PassingClock final : public Clock {
 public:
  Nanoseconds now() override { return now_; }
  void sleep_until(Nanoseconds deadline) override { now_ = std::max(now_, deadline); }
  bool is_real() const override { return true; }
  void pass(Nanoseconds time) { now_ += time; }

 private:
  Nanoseconds now_ = hours(100);
};

// Gives orders where the run stands, and notes when ticks began.
class Commander final : public Observer {
 public:
  void after_tick(const Moment&, const TickReport& report) override {
    begins.push_back(report.time);
    if (on_tick) on_tick(report.tick);
  }
  void standing(const Moment&) override { on_stand(stands++); }

  std::vector<Nanoseconds> begins;
  int stands = 0;  // the last is the end
  std::function<void(std::uint64_t tick)> on_tick;
  std::function<void(int stand)> on_stand = [](int) {};
};

int signal_of_test = 0;
int received_signal() {
  return signal_of_test;
}

struct Commanded {
  RunEnd run(const Tree& tree, LoopOptions options) {
    options.control = &control;
    Run it(tree, {});
    Observer* const observers[] = {&commander};
    return run_loop(it, clock, options, observers);
  }

  PassingClock clock;
  RunControl control;
  Commander commander;
};

LoopOptions at_ten_hertz(std::uint64_t ticks) {
  LoopOptions options;
  options.rate = 10;
  options.max_ticks = ticks;
  return options;
}

std::vector<Nanoseconds> multiples(std::uint64_t count) {
  std::vector<Nanoseconds> times;
  for (std::uint64_t k = 0; k < count; ++k) times.push_back(k * milliseconds(100));
  return times;
}

}  // namespace

TEST_CASE("a pause stops the leaves and the time of the run, and misses no deadline") {
  TimedLeaves leaves(3);
  Commanded it;
  it.commander.on_tick = [&](std::uint64_t tick) {
    if (tick == 3 || tick == 6) it.control.give({.what = What::Pause});
  };
  it.commander.on_stand = [&](int stand) {
    it.clock.pass(hours(1));
    if (stand == 0) it.control.give({.what = What::Resume});
    if (stand == 1) it.control.give({.what = What::Step, .ticks = 2});  // to tick 8
    if (stand == 2) it.control.give({.what = What::Resume});
  };
  const RunEnd end = it.run(leaves.tree, at_ten_hertz(20));
  CHECK(end.reason == StopReason::MaxTicks);
  CHECK(it.commander.begins == multiples(20));
  CHECK(it.commander.stands == 4);
  CHECK(end.overruns == 0);
  CHECK(end.skipped == 0);
  CHECK(end.time < std::chrono::seconds(3) + hours(0));
  CHECK(TimedLeaves::paused == 3 * 3);
  CHECK(TimedLeaves::resumed == 3 * 3);
}

TEST_CASE("nodes that count time lose none while somebody ticks step by step") {
  const Tree tree = tree_from_text("Wait[seconds=1]");
  Commanded it;
  it.control.give({.what = What::Pause});
  it.commander.on_stand = [&](int) {
    it.clock.pass(hours(1));
    it.control.give({.what = What::Step, .ticks = 1});
  };
  const RunEnd end = it.run(tree, at_ten_hertz(100));
  CHECK(end.status == Status::Success);
  CHECK(end.ticks == 11);
  CHECK(it.commander.stands == 12);
}

TEST_CASE("a pause is obeyed in the middle of a long period") {
  TimedLeaves leaves(1);
  Commanded it;
  it.commander.on_tick = [&](std::uint64_t) { it.control.give({.what = What::Pause}); };
  Nanoseconds stood{0};
  it.commander.on_stand = [&](int stand) {
    if (stand == 0) stood = it.clock.now() - hours(100);
    it.control.give({.what = What::Resume});
  };
  LoopOptions options = at_ten_hertz(2);
  options.rate = 0.001;
  it.run(leaves.tree, options);
  CHECK(stood < std::chrono::seconds(1));
  REQUIRE(it.commander.begins.size() == 2);
  CHECK(it.commander.begins[1] == std::chrono::seconds(1000));
}

TEST_CASE("a paused run obeys signals, its timeout and the order to halt") {
  TimedLeaves leaves(1);
  Commanded it;
  signal_of_test = 0;
  LoopOptions options = at_ten_hertz(100);
  options.stop_signal = received_signal;
  options.timeout = std::chrono::seconds(60);
  it.commander.on_tick = [&](std::uint64_t) { it.control.give({.what = What::Pause}); };
  SECTION("a signal") {
    it.commander.on_stand = [](int) { signal_of_test = 15; };
    const RunEnd end = it.run(leaves.tree, options);
    CHECK(end.reason == StopReason::Signal);
    CHECK(end.signal == 15);
    CHECK(end.time == milliseconds(100));
  }
  SECTION("the timeout, of real time") {
    it.commander.on_stand = [&](int stand) {
      if (stand == 0) it.clock.pass(std::chrono::seconds(60));
    };
    CHECK(it.run(leaves.tree, options).reason == StopReason::Timeout);
  }
  SECTION("the order to halt") {
    it.commander.on_stand = [&](int stand) {
      if (stand == 0) it.control.give({.what = What::Halt});
    };
    const RunEnd end = it.run(leaves.tree, options);
    CHECK(end.reason == StopReason::Signal);
    CHECK(end.signal == 2);
  }
  CHECK(TimedLeaves::paused == 1);
  CHECK(TimedLeaves::halted == 1);
  CHECK(it.commander.begins.size() == 1);
  signal_of_test = 0;
}

TEST_CASE("an answer that no tick takes is told at the end of the run, whenever it came") {
  // s is held from tick 1 on, in tick 0 it asks.
  const Tree tree = tree_from_text(
      "ParallelAbsolute[barriers=.5](AlwaysRunning Sequence[memory=true](AlwaysSuccess "
      "Ask[text=Now?]))");
  constexpr NodeIndex kAsk = 4;
  for (const std::uint64_t when : {0u, 3u, 5u}) {  // the last tick is 5
    INFO("tick " << when);
    Commanded it;
    std::vector<std::string> told;
    it.control.tell_vain_answers([&](const GivenAnswer& answer, RunControl::Vain why) {
      CHECK(why == RunControl::Vain::RunEnds);
      told.push_back(answer.answer + " of " + std::to_string(answer.node));
    });
    it.commander.on_tick = [&](std::uint64_t tick) {
      if (tick == when) it.control.give({.what = What::Answer, .node = kAsk, .text = "yes"});
    };
    it.run(tree, at_ten_hertz(6));
    CHECK(told == std::vector<std::string>{"yes of 4"});
  }
}

TEST_CASE("an answer that comes in the tick that ends the run is told, too") {
  const Tree tree = tree_from_text("Parallel[success_count=1](Wait[seconds=.2] Ask[text=Now?])");
  Commanded it;
  std::size_t told = 0;
  it.control.tell_vain_answers([&](const GivenAnswer& answer, RunControl::Vain why) {
    CHECK(why == RunControl::Vain::RunEnds);
    CHECK(answer.who == "maria");
    ++told;
  });
  it.commander.on_tick = [&](std::uint64_t tick) {
    if (tick != 2) return;
    it.control.give({.what = What::Answer, .node = 2, .text = "yes", .who = "maria"});
    it.control.give({.what = What::Resume});
  };
  CHECK(it.run(tree, at_ten_hertz(6)).ticks == 3);
  CHECK(told == 1);
}

TEST_CASE("steps that are ordered together add up") {
  TimedLeaves leaves(1);
  Commanded it;
  it.control.give({.what = What::Pause});
  std::vector<std::size_t> ticks;
  it.commander.on_stand = [&](int stand) {
    ticks.push_back(it.commander.begins.size());
    for (int i = 0; i < 3 && stand == 0; ++i) it.control.give({.what = What::Step, .ticks = 1});
    if (stand == 1) it.control.give({.what = What::Halt});
  };
  it.run(leaves.tree, at_ten_hertz(100));
  CHECK(ticks == std::vector<std::size_t>{0, 3, 3});
}

}  // namespace lockstep::host::test
