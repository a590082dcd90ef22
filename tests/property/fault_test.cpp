// After a fault no control node judges: on random trees, between the fault and the halt.
#include <catch2/catch.hpp>

#include "property/random_tree.h"
#include "support/scripted_run.h"

namespace lockstep::host::test {
namespace {

constexpr int kFaultTrees = 6000;
constexpr int kFewestFaults = 200;
constexpr int kFewestInHalt = 10;  // of these

// The node between the root and the leaf at fault that does not run, or the node that runs below
// one that does not; "" when all is as it must be.
std::string wrong_after_fault(Ticker& ticker) {
  const Tree& tree = ticker.tree();
  for (NodeIndex node = ticker.fault()->node; node != 0;) {
    node = tree.labels[node].parent;
    if (ticker.status(node) != Status::Running) return "does not run: " + tree.path(node);
  }
  for (NodeIndex node = 1; node < tree.nodes.size(); ++node) {
    if (ticker.status(node) != Status::Running) continue;
    if (ticker.status(tree.labels[node].parent) != Status::Running) {
      return "runs below a node that does not: " + tree.path(node);
    }
  }
  return "";
}

// Whether the run has ended with a fault.
bool tick_until_fault(ScriptedRun& run, const Trial& trial) {
  for (int tick = 0; tick < trial.ticks; ++tick) {
    run.events.clear();
    const Status status = run.tick_root(tick * from_seconds(trial.period));
    if (run.ticker().fault() == nullptr) continue;
    CHECK(status == Status::Running);
    return true;
  }
  return false;
}

}  // namespace

TEST_CASE("after a fault every ancestor of the leaf runs until the halt") {
  int faults = 0, in_halt = 0;
  for (std::uint64_t seed = 0; seed < kFaultTrees; ++seed) {
    const Trial trial = random_trial(seed);
    ScriptedRun run(tree_text(trial.plan), leaves_text(trial.plan));
    if (!tick_until_fault(run, trial)) continue;
    ++faults;
    in_halt += !run.events.empty() && run.events.back().call == Call::Halt;
    INFO("seed " << seed << ": " << tree_text(trial.plan) << ", " << leaves_text(trial.plan));
    REQUIRE(wrong_after_fault(run.ticker()) == "");
    run.ticker().halt_all();
    for (NodeIndex node = 0; node < run.tree().nodes.size(); ++node) {
      REQUIRE(run.ticker().status(node) == Status::Idle);
    }
  }
  CHECK(faults >= kFewestFaults);
  CHECK(in_halt >= kFewestInHalt);
}

}  // namespace lockstep::host::test
