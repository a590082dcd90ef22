// The time of verify is that of a run, also at rates whose period is no whole number of
// nanoseconds.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "base/core/random.h"
#include "dialect/btcpp/rules.h"
#include "run/loop.h"
#include "run/run.h"
#include "support/tree_text.h"
#include "verify/chance_runs.h"
#include "verify/verified.h"

namespace lockstep::host::test {
namespace {

constexpr double kRates[] = {3, 7, 9, 9.7, 10, 29.97, 30, 33, 60, 70, 90, 100, 120};

// {0} is a time and {1} twice of it.
constexpr const char* kTrees[] = {
    "Wait[seconds={0}]",
    "Sequence[memory=true](Wait[seconds=0.034] Wait[seconds={0}])",
    "Sequence[memory=true](Wait[seconds={0}] Timeout[seconds={0}](AlwaysRunning))",
    "Repeat[times=3](Delay[seconds={0}](AlwaysSuccess))",
    "Retry[attempts=3](Inverter(Wait[seconds={0}]))",
    "ParallelRelative[delta=0.1](Wait[seconds={0}] Wait[seconds={1}])",
    "ParallelAbsolute[barriers=0.4;0.7](Wait[seconds={0}] Wait[seconds={1}])",
    "ParallelRelative[delta=0.1](Timeout[seconds={1} clock=wall](Wait[seconds={0}]) "
    "Wait[seconds={1}])",
    "Parallel[success_count=1](Wait[seconds={1}] Repeat(Sequence[memory=true](AlwaysSuccess "
    "Cooldown[seconds={0}](AlwaysSuccess))))",
    "Parallel[success_count=1 failure_count=1](Timeout[seconds={1}](AlwaysRunning) "
    "Repeat(Rate[seconds={0}](AlwaysSuccess)))",
};

RunEnd run_of(const Tree& tree, double rate) {
  VirtualClock clock;
  Run run(tree, {.rate = rate, .virtual_time = true});
  LoopOptions options;
  options.rate = rate;
  options.max_ticks = 2000;
  return run_loop(run, clock, options, {});
}

// Whole milliseconds, and whole periods as people write them down.
std::vector<std::string> times_at(double rate, RandomStream& random) {
  std::vector<std::string> times;
  for (const double it : {2.0, 3.0, rate / 10}) {
    const double periods = std::max(1.0, std::round(it));
    for (const int digits : {3, 9}) {
      times.push_back(fmt::format("{:.{}f}", periods / rate, digits));
    }
  }
  for (int i = 0; i < 2; ++i) times.push_back(fmt::format("{:.3f}", random.next_double() / 2));
  return times;
}

}  // namespace

TEST_CASE("verify has the ticks of a run at each rate") {
  RandomStream random(1, 1);
  for (const double rate : kRates) {
    for (const std::string& time : times_at(rate, random)) {
      for (const char* const text : kTrees) {
        const std::string twice = fmt::format("{:.17f}", 2 * std::stod(time));
        const Verified it(fmt::format(fmt::runtime(text), time, twice), "", {}, rate);
        INFO(rate << " Hz: " << fmt::format(fmt::runtime(text), time, twice));
        const RunEnd end = run_of(it.tree, rate);
        REQUIRE(end.reason == StopReason::Completed);
        for (const Status status : {Status::Success, Status::Failure, Status::Skipped}) {
          const auto& found = it.found.results[index_of(status)];
          REQUIRE(found.has_value() == (status == end.status));
          if (found) CHECK(found->ticks == end.ticks);
        }
        CHECK_FALSE(
            find_contradiction(it.tree, it.models, it.properties, rate, it.found, {.runs = 2}));
      }
    }
  }
}

TEST_CASE("verify has the ticks of a run at each rate with the nodes of BehaviorTree.CPP") {
  constexpr const char* kTheirs[] = {"Sequence(Sleep[msec={}])",
                                     "Sequence(Delay[delay_msec={}](AlwaysSuccess))",
                                     "Sequence(Timeout[msec={}](Sleep[msec=2000]))"};
  for (const double rate : kRates) {
    for (const int time : {100, 333, 700}) {
      for (const char* const text : kTheirs) {
        const std::string tree = fmt::format(fmt::runtime(text), time);
        const Verified it(tree, "", {}, rate, {}, btcpp::kRules);
        INFO(rate << " Hz: " << tree);
        const RunEnd end = run_of(it.tree, rate);
        const auto& found = it.found.results[index_of(end.status)];
        REQUIRE(found.has_value());
        CHECK(found->ticks == end.ticks);
      }
    }
  }
}

TEST_CASE("a time that is held counts whole periods") {
  const std::string_view text =
      "Parallel(Wait[seconds=0.1] ParallelAbsolute[barriers=0.3;0.6](Wait[seconds=0.2] "
      "Wait[seconds=0.5]))";
  CHECK(run_of(tree_from_text(text), 30).ticks == 16);
}

}  // namespace lockstep::host::test
