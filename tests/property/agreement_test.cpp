// The engine against the reference interpreter, tick by tick, on random trees.
#include <catch2/catch.hpp>

#include "property/comparison.h"
#include "property/seeds.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

constexpr std::uint64_t kAgreementTrees = 10000, kGroupTrees = 7000, kRepeatedTrees = 500,
                        kPacedTrees = 4000;

// Reports the first few trials in which the engine differs from the reference interpreter.
template <class RandomTrial>
void compare_all(Seeds seeds, RandomTrial random_trial, Coverage* coverage, GroupCoverage* groups) {
  constexpr int kMostReported = 3;
  int failures = 0;
  for (std::uint64_t i = 0; i < seeds.count && failures < kMostReported; ++i) {
    const std::uint64_t seed = seeds.first + i;
    const Trial trial = random_trial(seed);
    if (difference(trial, coverage, groups).empty()) continue;
    FAIL_CHECK(report(seed, trial));
    ++failures;
  }
  REQUIRE(failures == 0);
}

// All that a run does, tick by tick, as one value.
struct Trace {
  std::vector<Status> statuses;
  std::vector<EventLog> events;
  RunState state;

  friend bool operator==(const Trace&, const Trace&) = default;
};

Trace trace(ScriptedRun& run, const Trial& trial) {
  Trace trace{{}, {}, run.ticker().run_state()};
  for (int tick = 0; tick < trial.ticks && run.ticker().fault() == nullptr; ++tick) {
    write_entries(run, trial, tick);
    trace.statuses.push_back(run.tick(tick * from_seconds(trial.period)));
    trace.events.push_back(run.events);
  }
  trace.state = run.ticker().run_state();
  return trace;
}

// Two runs do the same, and so does one that begins again.
void check_same_again(const Trial& trial) {
  const auto tree = tree_of(trial).tree;
  if (!tree) return;
  ScriptedRun one(*tree, leaves_text(trial.plan)), two(*tree, leaves_text(trial.plan));
  const Trace first = trace(one, trial);
  REQUIRE(first == trace(two, trial));
  one.restart();
  REQUIRE(one.ticker().run_state() == RunState(one.tree()));
  REQUIRE(first == trace(one, trial));
}

}  // namespace

TEST_CASE("the engine agrees with the reference interpreter on random trees") {
  Coverage coverage;
  const Seeds trials = seeds(0, kAgreementTrees);
  compare_all(trials, random_trial, &coverage, nullptr);
  if (trials.count >= kAgreementTrees) coverage.check();
}

TEST_CASE("the engine agrees with the law of barriers and resources on random trees") {
  GroupCoverage coverage;
  const Seeds trials = seeds(0, kGroupTrees);
  compare_all(trials, random_group_trial, nullptr, &coverage);
  if (trials.count >= kGroupTrees) coverage.check();
}

TEST_CASE("the engine agrees with the law of pacing on random trees") {
  const auto paced_trial = [](std::uint64_t seed) { return paced(random_trial(seed), seed); };
  compare_all(seeds(0, kPacedTrees), paced_trial, nullptr, nullptr);
}

TEST_CASE("the engine agrees with the law of pacing on random trees with barriers and resources") {
  GroupCoverage coverage;
  const auto paced_trial = [](std::uint64_t seed) { return paced(random_group_trial(seed), seed); };
  compare_all(seeds(0, kPacedTrees), paced_trial, nullptr, &coverage);
}

TEST_CASE("the same tree and seed give the same run") {
  for (std::uint64_t seed = 0; seed < kRepeatedTrees; ++seed) {
    for (const Trial& trial : {random_trial(seed), random_group_trial(seed)}) {
      INFO("seed " << seed << ": " << tree_text(trial.plan));
      check_same_again(trial);
    }
  }
}

}  // namespace lockstep::host::test
