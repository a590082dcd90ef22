// A SyncProgress on each child of a Parallel is, bit for bit, a synchronized parallel.
#include <catch2/catch.hpp>
#include <optional>

#include "engine/synchronized.h"
#include "property/random_tree.h"
#include "support/scripted_run.h"
#include "support/trials.h"

namespace lockstep::host::test {
namespace {

const std::uint64_t kSyncProgressTrees = trials(2500);

// A barrier or a pool. A member of a pool asks later where a parallel has held it.
bool has_group(const Plan& plan) {
  return !plan.barrier.empty() || !plan.pool.empty() ||
         std::ranges::any_of(plan.children, has_group);
}

// The first synchronized parallel of the tree. One that forgets starts children again, whose
// success a barrier remembers.
const Plan* synchronized_in(const Plan& plan) {
  const bool is_one = plan.kind == "ParallelAbsolute" || plan.kind == "ParallelRelative";
  if (is_one && !plan.forgets && !has_group(plan)) return &plan;
  for (const Plan& child : plan.children) {
    if (const Plan* found = synchronized_in(child)) return found;
  }
  return nullptr;
}

Plan across(const Plan& parallel) {
  Plan plan{.kind = "Parallel"};
  plan.hooks = parallel.hooks;
  plan.success_count = parallel.success_count;
  plan.failure_count = parallel.failure_count;
  for (const Plan& child : parallel.children) {
    plan.children.push_back({.kind = "SyncProgress", .children = {child}, .barrier = "g"});
  }
  Plan barrier{.kind = "barrier", .name = "g"};
  barrier.has_barriers = parallel.has_barriers;
  barrier.barriers = parallel.barriers;
  std::erase(barrier.barriers, 0);  // its members would begin together
  barrier.barrier_count = parallel.barrier_count;
  barrier.tick_at_barrier = parallel.tick_at_barrier;
  barrier.delta = parallel.delta;
  barrier.holds_between = parallel.holds_between;
  plan.beside.push_back(barrier);
  return plan;
}

// Of scripts; the tree is its last child.
Plan with_entries(Plan plan) {
  Plan root{.kind = "Sequence", .memory = true};
  root.beside = std::move(plan.beside);
  root.children = {Plan{.kind = "Script", .code = "x:=0;y:=1"}, std::move(plan)};
  return root;
}

// Of a run, all nodes but the members of the barrier and what is behind the root.
std::vector<Activity> activities(ScriptedRun& run) {
  std::vector<Activity> list;
  const Tree& tree = run.tree();
  for (NodeIndex node = 0; node < tree.nodes[0].end; ++node) {
    if (tree.labels[node].type->id != "SyncProgress") list.push_back(run.ticker().activity(node));
  }
  return list;
}

std::vector<double> snapshot(ScriptedRun& run) {
  const Tree& tree = run.tree();
  const NodeIndex node = tree.groups.empty() ? 2 : tree.groups[0].node;
  std::vector<double> progress;
  for (const double one : child_progress(run.ticker(), node)) {
    progress.push_back(is_left_out(one) ? -1 : one);
  }
  return progress;
}

// Whether the two could be compared: a run with a fault asks nobody else after it.
bool compare(const Trial& trial, const Plan& parallel) {
  Plan own = with_entries(parallel), other = with_entries(across(parallel));
  take_out_unknown_readings(own);
  take_out_unknown_readings(other);
  ScriptedRun one(tree_text(own), leaves_text(own));
  ScriptedRun two(tree_text(other), leaves_text(other));
  INFO(tree_text(parallel) << ", " << leaves_text(parallel));
  for (int tick = 0; tick < trial.ticks; ++tick) {
    INFO("tick " << tick);
    const Nanoseconds now = tick * from_seconds(trial.period);
    const Status status = one.tick(now), same = two.tick(now);
    if (one.ticker().fault() != nullptr || two.ticker().fault() != nullptr) return false;
    REQUIRE(status == same);
    REQUIRE(one.events == two.events);
    REQUIRE(activities(one) == activities(two));
    // Of a barrier that no member has reached in this tick, nobody asks.
    if (two.ticker().ticked(two.tree().groups[0].node)) REQUIRE(snapshot(one) == snapshot(two));
    if (trial.halt_every == 0 || tick % trial.halt_every != trial.halt_every - 1) continue;
    one.ticker().halt_all();
    two.ticker().halt_all();
  }
  return true;
}

}  // namespace

TEST_CASE("SyncProgress on all children of one Parallel is a synchronized parallel", "[trials]") {
  std::uint64_t compared = 0;
  std::uint64_t seed = 0;
  for (; compared < kSyncProgressTrees && seed < 10 * kSyncProgressTrees; ++seed) {
    const Trial trial = random_trial(seed);
    const Plan* parallel = synchronized_in(trial.plan);
    if (parallel == nullptr) continue;
    INFO("seed " << seed);
    compared += compare(trial, *parallel);
  }
  CHECK(compared == kSyncProgressTrees);
}

}  // namespace lockstep::host::test
