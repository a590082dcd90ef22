// What is around a call of a leaf: its mark, its time, and the floating-point mode.
#include "engine/leaf_watch.h"

#include <catch2/catch.hpp>
#include <cfenv>
#include <optional>
#include <stdexcept>

#include "base/system/float_mode.h"
#include "engine/leaf_call.h"
#include "engine/ticker.h"
#include "run/run.h"
#include "unit/plugin/probe_plugin.h"

namespace lockstep::host::test {
namespace {

using namespace std::chrono_literals;
using Strings = std::vector<std::string>;

// Stands still but for the calls that take time.
class CallClock final : public Clock {
 public:
  Nanoseconds now() override {
    ++reads;
    return time;
  }
  void sleep_until(Nanoseconds) override {}
  bool is_real() const override { return true; }

  Nanoseconds time{1h};
  int reads = 0;
};

struct WatchFixture {
  explicit WatchFixture(std::uint32_t full, std::uint32_t bare = 0, LeafWatchOptions options = {})
      : probe(full, bare), watch(completed(std::move(options))), blackboard(probe.tree()) {
    set.emplace(probe.tree(), blackboard, time, 1,
                [this](std::string_view who, lockstep_log_level, std::string_view text) {
                  log.push_back(std::string(who) + ": " + std::string(text));
                });
    ticker.emplace(probe.tree(), set->slots(), blackboard, FaultPolicy::Stop, &watch);
    watch.begin_tick();
  }
  ~WatchFixture() { on_probe_call = nullptr; }
  WatchFixture(const WatchFixture&) = delete;
  WatchFixture& operator=(const WatchFixture&) = delete;

  LeafWatchOptions completed(LeafWatchOptions options) {
    options.clock = &clock;
    options.on_slow = [this](NodeIndex leaf, PluginFunction function, Nanoseconds took) {
      slow.push_back(std::to_string(leaf) + " " + name_of(function) + " " +
                     std::to_string(took / 1ms));
    };
    options.on_float_mode = [this](std::optional<NodeIndex> leaf, PluginFunction function) {
      changed.push_back(leaf ? std::to_string(*leaf) + " " + name_of(function) : "somebody");
    };
    return options;
  }

  LeafSlot& slot(std::size_t leaf = 0) { return set->slots()[leaf]; }
  // A call of the leaf, as the engine makes it outside of the loop of a parent.
  void call(std::size_t leaf, PluginFunction function) {
    const LeafSlot& it = slot(leaf);
    const LeafCall around(*ticker, probe.tree().leaves[leaf].node, it, function);
    switch (function) {
      case PluginFunction::Start:
        return it.type->start(it.self);
      case PluginFunction::Halt:
        return it.type->halt(it.self);
      case PluginFunction::Pause:
        return it.type->pause(it.self);
      case PluginFunction::Resume:
        return it.type->resume(it.self);
      case PluginFunction::Progress:
        return static_cast<void>(it.type->progress(it.self));
      default:
        return static_cast<void>(it.type->tick(it.self));
    }
  }
  void tick(std::size_t leaf) { call(leaf, PluginFunction::Tick); }
  // A call of tick that takes this long.
  void tick(std::size_t leaf, Nanoseconds took) {
    on_probe_call = [this, took](PluginFunction, void*) { clock.time += took; };
    tick(leaf);
    on_probe_call = nullptr;
  }

  ProbeTree probe;
  CallClock clock;
  Strings slow, changed, log;
  LeafWatch watch;
  Blackboard blackboard;
  LeafTime time;
  std::optional<LeafSet> set;
  std::optional<Ticker> ticker;
};

TEST_CASE("a leaf is not blamed for what lockstep carries between processes") {
  Strings carried;
  LeafWatchOptions options{.budget = 10ms};
  options.on_carried = [&](NodeIndex leaf, Nanoseconds took) {
    carried.push_back(std::to_string(leaf) + " " + std::to_string(took / 1ms));
  };
  WatchFixture fixture(1, 0, options);
  const auto call = [&](Nanoseconds own, Nanoseconds on_the_way) {
    on_probe_call = [&, own, on_the_way](PluginFunction, void*) {
      fixture.clock.time += own + on_the_way;
      CallMark::this_thread().carried += on_the_way;
    };
    fixture.tick(0);
    on_probe_call = nullptr;
    fixture.clock.time += 2s;  // something is told once a second
  };
  call(5ms, 80ms);
  CHECK(fixture.slow.empty());
  CHECK(carried == Strings{"0 80"});
  CHECK(fixture.watch.slowest().took == 5ms);
  call(12ms, 80ms);
  CHECK(fixture.slow == Strings{"0 tick 12"});
  call(5ms, 0ms);
  CHECK(carried.size() == 1);
  REQUIRE(fixture.watch.over_budget().size() == 1);
  CHECK(fixture.watch.over_budget()[0].over_budget == 1);
  CHECK(CallMark::this_thread().carried == 0ms);
}

TEST_CASE("every call reaches its leaf, marked with its function, site and tick") {
  WatchFixture fixture(2);
  std::vector<void*> leaves;
  Strings seen;
  on_probe_call = [&](PluginFunction function, void* self) {
    if (function == PluginFunction::Create) return leaves.push_back(self);
    if (function == PluginFunction::Destroy || leaves.size() < 2) return;
    const CallMark& mark = CallMark::this_thread();
    REQUIRE(mark.look().function == function);
    seen.push_back(std::string(name_of(function)) + (self == leaves[1] ? " 1 " : " 0 ") +
                   mark.look().site->text() + " " + std::to_string(mark.tick()));
  };
  fixture.set->destroy_all();
  fixture.set->create_all(1);
  CallMark::this_thread().set_tick(12);
  for (const auto function :
       {PluginFunction::Start, PluginFunction::Tick, PluginFunction::Pause,
        PluginFunction::Progress, PluginFunction::Resume, PluginFunction::Halt}) {
    fixture.call(1, function);
  }
  const std::string rest = " 1 'Main/leaf0/leaf1' (Full of plugin 'probe') 12";
  CHECK(seen == Strings{"start" + rest, "tick" + rest, "pause" + rest, "progress" + rest,
                        "resume" + rest, "halt" + rest});
  CHECK(CallMark::this_thread().look().function == PluginFunction::None);
}

TEST_CASE("a call within a call of a control node is marked and timed by itself") {
  WatchFixture fixture(2, 0, {.budget = 30ms});
  int depth = 0;
  on_probe_call = [&](PluginFunction, void*) {
    if (depth++ != 0) {
      fixture.clock.time += 20ms;
      return;
    }
    fixture.clock.time += 15ms;
    fixture.tick(1);
    const CallMark::Look look = CallMark::this_thread().look();
    CHECK(look.function == PluginFunction::Tick);
    CHECK(look.site->text() == "'Main/leaf0' (Full of plugin 'probe')");
    fixture.clock.time += 10ms;
  };
  fixture.tick(0);
  on_probe_call = nullptr;
  CHECK(depth == 2);
  CHECK(CallMark::this_thread().look().function == PluginFunction::None);
  CHECK(fixture.watch.slowest().took == 25ms);
  CHECK(fixture.watch.slowest().leaf == 0);
  CHECK(fixture.slow.empty());  // 45 ms with its child
}

TEST_CASE("an exception of a watched leaf is a fault of the run") {
  const ProbeTree probe(1);
  LeafWatch watch({.budget = 1s});
  Run run(probe.tree(), {.log = {}, .watch = &watch});
  CHECK(run.watch() == &watch);
  std::uint64_t tick = 0;
  on_probe_call = [&](PluginFunction function, void*) {
    tick = CallMark::this_thread().tick();
    if (function == PluginFunction::Tick && tick == 2) throw std::runtime_error("no arm");
  };
  for (int i = 0; i < 3; ++i) {
    REQUIRE(run.fault() == nullptr);
    run.tick(i * 10ms);
  }
  on_probe_call = nullptr;
  CHECK(tick == 2);
  REQUIRE(run.fault() != nullptr);
  CHECK(run.fault()->message == "threw an exception: no arm");
  CHECK(CallMark::this_thread().look().function == PluginFunction::None);
  CHECK(watch.slowest().function != PluginFunction::None);  // it was timed, too
}

TEST_CASE("a leaf that changes the rounding mode has it set back, and is reported once") {
  WatchFixture fixture(2);
  const FloatMode before = FloatMode::current();
  on_probe_call = [](PluginFunction, void*) { std::fesetround(FE_UPWARD); };
  for (const std::size_t leaf : {0, 1, 1, 0}) {
    fixture.tick(leaf);
    CHECK(std::fegetround() == FE_TONEAREST);
    CHECK(FloatMode::current() == before);
  }
  on_probe_call = nullptr;
  CHECK(fixture.changed == Strings{"0 tick", "1 tick"});
}

TEST_CASE("long double is set back, too") {
  WatchFixture fixture(1);
  volatile long double one = 1, three = 3;
  const long double third = one / three;
  on_probe_call = [](PluginFunction, void*) { std::fesetround(FE_UPWARD); };
  fixture.call(0, PluginFunction::Halt);
  on_probe_call = nullptr;
  CHECK(one / three == third);
}

TEST_CASE("what a computation raises is no change of the mode") {
  WatchFixture fixture(1);
  on_probe_call = [](PluginFunction, void*) { std::feraiseexcept(FE_ALL_EXCEPT); };
  fixture.tick(0);
  on_probe_call = nullptr;
  CHECK(fixture.changed.empty());
  CHECK(std::fetestexcept(FE_OVERFLOW) != 0);
  std::feclearexcept(FE_ALL_EXCEPT);
}

TEST_CASE("a leaf whose create changes the rounding mode has it set back, and a line in the log") {
  WatchFixture fixture(1);
  fixture.set->destroy_all();
  on_probe_call = [](PluginFunction function, void*) {
    if (function == PluginFunction::Create) std::fesetround(FE_DOWNWARD);
  };
  fixture.set->create_all(1);
  CHECK(std::fegetround() == FE_TONEAREST);
  CHECK(fixture.log == Strings{"Main/leaf0: its create has changed the rounding mode or the "
                               "floating-point exceptions; they were restored"});
}

TEST_CASE("a call over the budget counts, and is reported with what it took") {
  WatchFixture fixture(2, 0, {.budget = 5ms});
  for (const auto took : {1ms, 5ms, 6ms, 7ms, 2ms}) fixture.tick(1, took);
  CHECK(fixture.slow == Strings{"1 tick 6"});
  const std::vector<LeafWatch::Timing> over = fixture.watch.over_budget();
  REQUIRE(over.size() == 1);  // leaf 0 was not called
  CHECK(over[0].leaf == 1);
  CHECK(over[0].ticks == 5);
  CHECK(over[0].over_budget == 2);
  CHECK(over[0].max == 7ms);
  CHECK((over[0].p50 >= 5ms && over[0].p50 <= 5313us));
  CHECK(over[0].p99 == 7ms);
}

TEST_CASE("slow calls are reported once a second, whichever leaf it is, and all count") {
  WatchFixture fixture(2, 0, {.budget = 5ms});
  const Nanoseconds start = fixture.clock.time;
  const auto call_at = [&](Nanoseconds end, std::size_t leaf) {
    fixture.clock.time = start + end - 10ms;
    fixture.tick(leaf, 10ms);
  };
  call_at(100ms, 0);
  call_at(200ms, 1);
  call_at(1099ms, 0);
  call_at(1100ms, 1);
  call_at(2099ms, 1);
  call_at(2100ms, 0);
  CHECK(fixture.slow == Strings{"0 tick 10", "1 tick 10", "0 tick 10"});
  const auto over = fixture.watch.over_budget();
  REQUIRE(over.size() == 2);
  CHECK(over[0].over_budget + over[1].over_budget == 6);
}

TEST_CASE("a slow halt counts, though it is no tick, and the longest call comes first") {
  WatchFixture fixture(2, 0, {.budget = 5ms});
  fixture.tick(0, 6ms);
  on_probe_call = [&](PluginFunction, void*) { fixture.clock.time += 1500ms; };
  fixture.call(1, PluginFunction::Halt);
  on_probe_call = nullptr;
  CHECK(fixture.slow == Strings{"0 tick 6", "1 halt 1500"});
  const auto over = fixture.watch.over_budget();
  REQUIRE(over.size() == 2);
  CHECK((over[0].leaf == 1 && over[0].ticks == 0 && over[0].over_budget == 1));
  CHECK(over[0].max == 1500ms);
  CHECK(over[1].leaf == 0);
}

TEST_CASE("the slowest call is that of the tick that goes on") {
  WatchFixture fixture(3, 0, {.budget = 1s});
  fixture.watch.begin_tick();
  CHECK(fixture.watch.slowest().function == PluginFunction::None);
  fixture.tick(0, 2ms);
  fixture.tick(1, 3ms);
  fixture.tick(2, 1ms);
  CHECK(fixture.watch.slowest().leaf == 1);
  CHECK(fixture.watch.slowest().function == PluginFunction::Tick);
  CHECK(fixture.watch.slowest().took == 3ms);
  fixture.watch.begin_tick();
  fixture.tick(2, 1ms);
  CHECK(fixture.watch.slowest().leaf == 2);
}

TEST_CASE("calls are not timed when there is no budget") {
  WatchFixture fixture(1);
  fixture.tick(0, 1s);
  CHECK(fixture.clock.reads == 0);
  CHECK(fixture.watch.slowest().function == PluginFunction::None);
  CHECK(fixture.watch.over_budget().empty());
}

// --- in a tick of the tree, where a leaf is called in the loop of its parent ---------------------

// Two leaves in a tree that runs on.
struct Ticking {
  explicit Ticking(LeafWatchOptions options)
      : watch([&] {
          options.clock = &clock;
          options.on_float_mode = [this](std::optional<NodeIndex> leaf, PluginFunction function) {
            changed.push_back(leaf ? std::to_string(*leaf) + " " + name_of(function) : "somebody");
          };
          return options;
        }()),
        run(probe.tree(), {.log = {}, .watch = &watch}) {}
  ~Ticking() { on_probe_call = nullptr; }
  Ticking(const Ticking&) = delete;
  Ticking& operator=(const Ticking&) = delete;

  void tick(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) run.tick(count++ * 10ms);
  }

  ProbeTree probe{"<Parallel><Full name=\"leaf0\"/><Full name=\"leaf1\"/></Parallel>"};
  CallClock clock;
  Strings changed;
  LeafWatch watch;
  Run run;
  int count = 0;
};

TEST_CASE(
    "in a tick every call is marked, and one reading of the time ends one and begins the next") {
  Ticking it({.budget = 1s});
  it.tick();  // looks after each call
  Strings seen;
  on_probe_call = [&](PluginFunction function, void*) {
    const CallMark::Look look = CallMark::this_thread().look();
    seen.push_back(std::string(name_of(function)) + " " + look.site->path + " " +
                   std::to_string(look.tick));
    it.clock.time += seen.size() * 10ms;
  };
  it.clock.reads = 0;
  it.tick();
  CHECK(seen == Strings{"tick Main/Parallel/leaf0 1", "tick Main/Parallel/leaf1 1"});
  CHECK(it.clock.reads == 3);
  CHECK(it.watch.slowest().took == 20ms);
  CHECK(it.watch.slowest().leaf == 2);
  CHECK(CallMark::this_thread().look().function == PluginFunction::None);
}

TEST_CASE("a leaf that is ticked again in the same tick is in another call, which is no hang") {
  Ticking it({});
  it.tick();
  std::vector<CallMark::Look> looks;
  on_probe_call = [&](PluginFunction, void*) { looks.push_back(CallMark::this_thread().look()); };
  it.tick();
  it.run.ticker().tick_root_again();
  REQUIRE(looks.size() == 4);
  CHECK(looks[0].site == looks[2].site);
  CHECK(looks[0].tick == looks[2].tick);
  CHECK_FALSE(looks[0] == looks[2]);
}

TEST_CASE("a mode that is changed in the first tick is set back at once, and the leaf is named") {
  Ticking it({});
  int calls = 0;
  on_probe_call = [&](PluginFunction, void*) {
    CHECK(std::fegetround() == FE_TONEAREST);
    if (++calls == 1) std::fesetround(FE_UPWARD);
  };
  it.tick(3);
  CHECK(it.changed == Strings{"1 start"});
}

TEST_CASE(
    "a mode that is changed later is set back after the tick, and who does so again is named") {
  Ticking it({});
  it.tick(5);
  int calls = 0;
  bool changes = true;
  on_probe_call = [&](PluginFunction function, void*) {
    if (function == PluginFunction::Tick && ++calls % 2 == 0 && changes) std::fesetround(FE_UPWARD);
  };
  it.tick();
  CHECK(std::fegetround() == FE_TONEAREST);
  CHECK(it.changed == Strings{"somebody"});
  it.tick();
  CHECK(std::fegetround() == FE_TONEAREST);
  CHECK(it.changed == Strings{"somebody", "2 tick"});
  changes = false;
  it.tick(3);
  CHECK(it.changed.size() == 2);
}

TEST_CASE("who changes the mode now and then is found, for the search takes longer each time") {
  Ticking it({});
  it.tick(5);
  int calls = 0;
  on_probe_call = [&](PluginFunction function, void*) {
    if (function == PluginFunction::Tick && ++calls % 10 == 0) std::fesetround(FE_UPWARD);
  };
  it.tick(30);
  on_probe_call = nullptr;
  CHECK(it.changed == Strings{"somebody", "2 tick"});
  CHECK(std::fegetround() == FE_TONEAREST);
}

// --- where only some ticks are timed -------------------------------------------------------------

// Ticks that are not timed, with a budget of 10 ms. The alarm rings when somebody looks at it.
struct Alarmed {
  Alarmed()
      : it([this] {
          LeafWatchOptions options{.budget = 10ms, .alarm = &alarm};
          options.on_slow = [this](NodeIndex leaf, PluginFunction function, Nanoseconds took) {
            slow.push_back(std::to_string(leaf) + " " + name_of(function) + " " +
                           std::to_string(took / 1us));
          };
          return options;
        }()) {
    it.tick(kTimed);
  }
  ~Alarmed() { on_probe_call = nullptr; }
  Alarmed(const Alarmed&) = delete;
  Alarmed& operator=(const Alarmed&) = delete;

  // In each tick the two leaves take this long; the alarm looks when so much of that is over.
  void tick(Nanoseconds first, Nanoseconds second, std::optional<Nanoseconds> look = {}) {
    const Nanoseconds begin = it.clock.time;
    int calls = 0;
    on_probe_call = [&, first, second, look, begin](PluginFunction, void*) {
      const Nanoseconds end = it.clock.time + (calls++ == 0 ? first : second);
      if (look && begin + *look > it.clock.time && begin + *look <= end) alarm.look(begin + *look);
      it.clock.time = end;
    };
    it.tick();
    on_probe_call = nullptr;
  }
  const LeafWatch::Timing* over() const {
    over_ = it.watch.over_budget();
    return over_.empty() ? nullptr : &over_[0];
  }

  static constexpr int kTimed = 64;  // each of the first ones
  TickAlarm alarm{1ms, 100ms};
  Strings slow;
  Ticking it;
  mutable std::vector<LeafWatch::Timing> over_;
};

TEST_CASE("a tick within the budget takes two readings of the time, and times no call") {
  Alarmed alarmed;
  int least = 1000;
  for (int i = 0; i < 100; ++i) {  // some are samples
    alarmed.it.clock.reads = 0;
    alarmed.tick(3ms, 4ms);
    least = std::min(least, alarmed.it.clock.reads);
  }
  CHECK(least == 2);
  CHECK(alarmed.slow.empty());
  CHECK(alarmed.it.watch.over_budget().empty());
}

TEST_CASE("a call over the budget is named the first time, to a tenth of the budget") {
  struct Row {
    Nanoseconds first, second;
    const char* wanted;
  };
  for (const auto& [first, second, wanted] :
       {Row{15ms, 1ms, "1 tick 15000"}, Row{500us, 15ms, "2 tick 15"},
        Row{11ms, 12ms, "1 tick 11000"}}) {
    Alarmed alarmed;
    alarmed.tick(first, second, 1ms);
    REQUIRE(alarmed.slow.size() == 1);
    CHECK(alarmed.slow[0].starts_with(wanted));
    REQUIRE(alarmed.over() != nullptr);
    const Nanoseconds longest = std::max(first, second);
    CHECK(std::chrono::abs(alarmed.over()->max - longest) <= 1ms);
  }
}

TEST_CASE(
    "where the alarm does not ring in time, the next ticks are timed, and the call is found") {
  Alarmed alarmed;
  alarmed.tick(15ms, 1ms);
  CHECK(alarmed.slow.empty());
  alarmed.tick(15ms, 1ms);
  CHECK(alarmed.slow == Strings{"1 tick 15000"});
}

TEST_CASE("a leaf that was over the budget is timed in each tick, and others in none") {
  Alarmed alarmed;
  alarmed.tick(15ms, 1ms, 1ms);
  alarmed.it.clock.time += 1s;
  for (int i = 0; i < 200; ++i) alarmed.tick(2ms, 1ms);
  REQUIRE(alarmed.over() != nullptr);
  CHECK(alarmed.over()->leaf == 1);
  CHECK(alarmed.over()->is_sampled);
  CHECK(alarmed.over()->ticks == Alarmed::kTimed + 1 + 200);
  CHECK(alarmed.over()->p50 >= 2ms);
  CHECK(alarmed.over()->p50 < 2200us);
  alarmed.tick(15ms, 1ms);  // and is told of without an alarm
  CHECK(alarmed.slow == Strings{"1 tick 15000", "1 tick 15000"});
  alarmed.tick(15ms, 1ms, 1ms);  // nor does one blame the leaf behind it
  CHECK(alarmed.it.watch.over_budget().size() == 1);
}

TEST_CASE("an alarm rings once in a tick, when the tick lasts, and expects the next one") {
  TickAlarm alarm(1ms, 10ms);
  ForkGuard::Byte byte;
  alarm.attach(&byte);
  alarm.begin_tick(100ms);
  CHECK(alarm.look(100ms) == 101ms);
  CHECK_FALSE(alarm.rang());
  CHECK(alarm.look(101ms) == 111ms);
  CHECK(alarm.rang() == Nanoseconds(101ms));
  CHECK_FALSE(byte.is_set());
  byte.set();
  alarm.look(102ms);
  CHECK(byte.is_set());
  CHECK(alarm.rang() == Nanoseconds(101ms));
  alarm.end_tick();
  CHECK_FALSE(alarm.rang());
  CHECK(alarm.look(103ms) == 111ms);
  CHECK(byte.is_set());
  CHECK(alarm.look(111ms) == 112ms);  // the next one is late
  CHECK(alarm.look(150ms) == 160ms);  // there is none
  alarm.attach(nullptr);
}

}  // namespace
}  // namespace lockstep::host::test
