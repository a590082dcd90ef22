// Actions of plugins/motion whose reported progress is late or comes in steps, and how far apart a
// synchronized node then lets its children get.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/synchronized.h"
#include "unit/plugins/tree_run.h"

namespace lockstep::host::test {
namespace {

// What 'a' reports after each tick at 100 Hz, in tenths.
std::vector<int> reports(const std::string& nodes, std::size_t ticks) {
  const TreeRunner runner("motion", nodes);
  const NodeIndex node = runner.node("a");
  std::vector<int> tenths;
  const auto ask = [&](Ticker& ticker) {
    tenths.push_back(static_cast<int>(std::lround(ticker.progress(node) * 10)));
  };
  const double period = 0.01;
  const TreeRunEnd end =
      runner.run({.limit = period * (static_cast<double>(ticks) - 0.5), .after_tick = ask});
  CHECK(end.fault.empty());
  return tenths;
}

// Beside an action that never gets anywhere: 'a' is held as soon as it reports a progress.
std::string beside_one_that_stands(const std::string& a) {
  return "<ParallelRelative delta=\"0\"><" + a + "/><Advance step=\"0\"/></ParallelRelative>";
}

}  // namespace

TEST_CASE("a late action reports what it was, rounded up to whole ticks", "[plugins][motion]") {
  using Tenths = std::vector<int>;
  CHECK(reports("<Advance name=\"a\" step=\"0.1\"/>", 6) == Tenths{1, 2, 3, 4, 5, 6});
  for (const char* latency : {"0.03", "0.021", "0.025"}) {
    CHECK(reports(fmt::format("<Advance name=\"a\" step=\"0.1\" latency=\"{}\"/>", latency), 7) ==
          Tenths{0, 0, 0, 0, 1, 2, 3});
  }
  CHECK(reports("<Advance name=\"a\" step=\"0.1\" latency=\"0.001\"/>", 4) == Tenths{0, 0, 1, 2});
  CHECK(reports("<Profile name=\"a\" step=\"0.1\" latency=\"0.03\"/>", 7) ==
        Tenths{0, 0, 0, 0, 1, 2, 3});
  // What moves in time is as old as its latency, to the nanosecond. (0.8 tenths are shown as 1.)
  CHECK(reports("<Profile name=\"a\" clock=\"time\" step=\"10\" latency=\"0.022\"/>", 6) ==
        Tenths{0, 0, 0, 1, 2, 3});
}

TEST_CASE("what a held action reports goes on until it is up to date", "[plugins][motion]") {
  using Tenths = std::vector<int>;
  // Ticked four times, until it reports 0.1: then it is at 0.4 and held.
  for (const char* action : {"Advance", "Profile"}) {
    const std::string a = fmt::format("{} name=\"a\" step=\"0.1\" latency=\"0.03\"", action);
    CHECK(reports(beside_one_that_stands(a), 10) == Tenths{0, 0, 0, 0, 1, 2, 3, 4, 4, 4});
  }
  // In time it moves on while it is held.
  CHECK(reports(beside_one_that_stands(
                    "Profile name=\"a\" clock=\"time\" step=\"10\" latency=\"0.03\""),
                10) == Tenths{0, 0, 0, 0, 1, 2, 3, 4, 5, 6});
}

TEST_CASE("progress in steps is rounded down", "[plugins][motion]") {
  using Tenths = std::vector<int>;
  CHECK(reports("<Advance name=\"a\" step=\"0.1\" quantize=\"0.3\"/>", 9) ==
        Tenths{0, 0, 3, 3, 3, 6, 6, 6, 9});
  CHECK(reports("<Advance name=\"a\" step=\"0.1\" quantize=\"0.3\" latency=\"0.02\"/>", 9) ==
        Tenths{0, 0, 0, 0, 0, 3, 3, 3, 6});
  CHECK(reports("<Profile name=\"a\" step=\"0.1\" quantize=\"1\"/>", 9) ==
        Tenths{0, 0, 0, 0, 0, 0, 0, 0, 0});
}

TEST_CASE("a late action is not done later, and begins again at 0", "[plugins][motion]") {
  for (const char* late : {"latency=\"0.5\"", "quantize=\"0.7\"", "latency=\"9\" quantize=\"1\""}) {
    for (const char* action : {"Advance", "Profile"}) {
      const std::string a = fmt::format("<{} name=\"a\" step=\"0.1\" {}/>", action, late);
      CHECK(TreeRunner("motion", a).run().seconds == Approx(0.1));
    }
  }
  const auto twice = reports(
      "<Repeat times=\"2\"><Advance name=\"a\" step=\"0.2\" latency=\"0.02\"/></Repeat>", 8);
  CHECK(twice == std::vector<int>{0, 0, 0, 2, 10, 0, 0, 0});
}

TEST_CASE("a latency below 0 and steps above 1 are refused", "[plugins][motion]") {
  for (const char* wrong : {"latency=\"-0.1\"", "quantize=\"1.5\"", "quantize=\"-0.1\""}) {
    const std::string a = fmt::format("<Advance {}/>", wrong);
    CHECK_THROWS(TreeRunner("motion", a));
  }
}

namespace {

struct LateAction {
  double step, noise;
  int latency;  // ticks
  double quantize;

  // How far it may be ahead of where its reports let it be.
  double overshoot() const { return quantize + (latency + 1) * (step + noise); }
};

// How far each action was ahead of the others at most, less what the bound allows; of all runs.
class BoundCheck {
 public:
  void run(const std::string& keeper, double allowed, const std::vector<LateAction>& actions) {
    std::string nodes;
    for (std::size_t i = 0; i < actions.size(); ++i) {
      const LateAction& it = actions[i];
      nodes += fmt::format(
          "<Advance step=\"{}\" noise=\"{}\" latency=\"{}\" quantize=\"{}\" actual=\"{{p{}}}\"/>",
          it.step, it.noise, it.latency * 0.01, it.quantize, i);
    }
    const std::string kind = keeper.substr(0, keeper.find(' '));
    const TreeRunner runner("motion", "<" + keeper + ">" + nodes + "</" + kind + ">");
    const auto check = [&](Ticker& ticker) {
      std::vector<double> actual;
      for (const Entry& entry : ticker.blackboard().entries) {
        const auto* number = std::get_if<double>(&entry.value());
        actual.push_back(number == nullptr ? 0 : *number);
      }
      REQUIRE(actual.size() == actions.size());
      const double least = *std::ranges::min_element(actual);
      for (std::size_t i = 0; i < actions.size(); ++i) {
        const double bound = allowed + actions[i].overshoot();
        worst_ = std::max(worst_, actual[i] - least - bound);
        if (bound < 1) nearest_ = std::max(nearest_, (actual[i] - least) / bound);
      }
    };
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const TreeRunEnd end = runner.run({.seed = seed, .after_tick = check});
      CHECK(end.status == Status::Success);
    }
  }

  double worst() const { return worst_; }      // above 0: the bound is broken
  double nearest() const { return nearest_; }  // as a share of the bound

 private:
  double worst_ = -1, nearest_ = 0;
};

// Two or three actions, of which the first is the fastest; the others may be as late, or not.
void check_grid(BoundCheck& check, const std::string& keeper, double allowed) {
  for (const int latency : {0, 1, 2, 5, 12}) {
    for (const double quantize : {0.0, 0.03, 0.1, 0.25}) {
      for (const double noise : {0.0, 0.01}) {
        const LateAction fast{0.03, noise, latency, quantize};
        check.run(keeper, allowed, {fast, {0.01, noise, latency, quantize}});
        check.run(keeper, allowed, {fast, {0.01, noise, 0, 0}, {0.02, noise, 3, 0.07}});
        check.run(keeper, allowed, {{0.01, noise, 0, 0}, fast});
      }
    }
  }
}

}  // namespace

TEST_CASE("late actions are never further apart than the bound", "[plugins][motion]") {
  for (const double delta : {0.0, 0.02, 0.1, 0.3}) {
    BoundCheck check;
    check_grid(check, fmt::format("ParallelRelative delta=\"{}\"", delta), delta);
    INFO("delta " << delta);
    CHECK(check.worst() <= 1e-9);
    CHECK(check.nearest() > 0.9);
  }
  for (const int count : {0, 2, 5, 20}) {
    for (const char* at_barrier : {"wait", "tick"}) {
      BoundCheck check;
      const double distance = 1.0 / std::max(count, 1);
      check_grid(
          check,
          fmt::format("ParallelAbsolute barrier_count=\"{}\" at_barrier=\"{}\"", count, at_barrier),
          distance);
      INFO(count << " barriers, " << at_barrier);
      CHECK(check.worst() <= 1e-9);
      if (count > 2) CHECK(check.nearest() > 0.8);
    }
  }
}

}  // namespace lockstep::host::test
