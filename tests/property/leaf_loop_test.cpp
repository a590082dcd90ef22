// Leaves that their parent calls in a loop do what they do when each is called by itself: on the
// random trees of both languages, where a third of the actions has no function but tick, and
// another third all but start.
#include "engine/leaf_loop.h"

#include <catch2/catch.hpp>
#include <functional>

#include "property/btcpp_tree.h"
#include "property/comparison.h"
#include "support/scripted_types.h"
#include "support/step_clock.h"
#include "support/trials.h"

namespace lockstep::host::test {
namespace {

const std::uint64_t kLoopTrees = trials(1250);
constexpr int kLoopTicks = 30;

struct LoopTick {
  Status status;
  EventLog events;
  RunState run;
  std::vector<double> progress;
  std::vector<Value> entries;

  friend bool operator==(const LoopTick&, const LoopTick&) = default;
};

struct LoopRun {
  Tree tree;
  std::string leaves;
  FaultPolicy policy = FaultPolicy::Stop;
  double period = 0.1;
  std::function<void(ScriptedRun&, int tick)> write = [](ScriptedRun&, int) {};
};

std::vector<LoopTick> ticks_of(const LoopRun& it, LeafWatch* watch) {
  ScriptedRun run(it.tree, it.leaves, it.policy, watch);
  std::vector<LoopTick> ticks;
  for (int tick = 0; tick < kLoopTicks && run.ticker().fault() == nullptr; ++tick) {
    run.events.clear();
    it.write(run, tick);
    const Status status = run.tick(tick * from_seconds(it.period));
    ticks.push_back({status, run.events, run.ticker().run_state(), {}, {}});
    for (NodeIndex node = 0; node < it.tree.nodes.size(); ++node) {
      ticks.back().progress.push_back(run.ticker().progress(node));
    }
    for (const Entry& entry : run.ticker().blackboard().entries) {
      ticks.back().entries.push_back(entry.value());
    }
  }
  return ticks;
}

void check_loop(LoopRun it, std::uint64_t seed) {
  constexpr const NodeType* kTypes[] = {&kScriptedActionType, &kBareActionType,
                                        &kStartlessActionType};
  for (std::size_t leaf = 0; leaf < it.tree.leaves.size(); ++leaf) {
    if (it.tree.leaves[leaf].type->leaf != &kScriptedAction) continue;
    it.tree.leaves[leaf].type = kTypes[(seed + leaf) % std::size(kTypes)];
  }
  it.policy = seed % 2 == 0 ? FaultPolicy::Stop : FaultPolicy::Fail;
  LeafWatch alone({.budget = {}, .looks_after_each_call = true});
  const std::vector<LoopTick> expected = ticks_of(it, &alone);
  REQUIRE(ticks_of(it, nullptr) == expected);
  StepClock clock;
  LeafWatch timed({.budget = std::chrono::hours(1), .clock = &clock});
  REQUIRE(ticks_of(it, &timed) == expected);
}

void check_trial(const Trial& trial, std::uint64_t seed) {
  const auto tree = tree_of(trial).tree;
  if (!tree) return;
  INFO("seed " << seed << ": " << leaves_text(trial.plan));
  check_loop({.tree = *tree,
              .leaves = leaves_text(trial.plan),
              .period = trial.period,
              .write = [&](ScriptedRun& run, int tick) { write_entries(run, trial, tick); }},
             seed);
}

}  // namespace

TEST_CASE("leaves in a loop do what they do alone, on random trees", "[trials]") {
  for (std::uint64_t seed = 0; seed < kLoopTrees; ++seed) {
    check_trial(random_trial(seed), seed);
    check_trial(random_group_trial(seed), seed);
  }
}

TEST_CASE("leaves in a loop do what they do alone, on random trees for BehaviorTree.CPP",
          "[trials]") {
  for (std::uint64_t seed = 1; seed <= kLoopTrees; ++seed) {
    const law::Document document = law::random_document(seed);
    INFO("seed " << seed << ": " << law::to_xml(document));
    check_loop({.tree = law::tree_of(document), .leaves = law::leaves_text(document)}, seed);
  }
}

}  // namespace lockstep::host::test
