// Parallel and ParallelAll of BehaviorTree.CPP. A child that completed is not ticked again in the
// activation; its status says so.
#include <algorithm>
#include <optional>
#include <utility>

#include "dialect/btcpp/nodes/kinds.h"
#include "engine/leaf_loop.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/parallel_rule.h"

namespace lockstep::host::btcpp {
namespace {

constexpr unsigned kSuccessCount = 0, kFailureCount = 1;
constexpr unsigned kMaxFailures = 0;

constexpr Parameter kParallelParameters[] = {
    {.name = "success_count",
     .type = ValueType::Int,
     .doc = "How many children must succeed for Success; -1 all, -2 all but one, and so on.",
     .default_text = "-1"},
    {.name = "failure_count",
     .type = ValueType::Int,
     .doc = "How many children must fail for Failure; -1 all, -2 all but one, and so on.",
     .default_text = "1"}};

constexpr Parameter kAllParameters[] = {
    {.name = "max_failures",
     .type = ValueType::Int,
     .doc = "From how many children that fail on it is a Failure; -1 all, -2 all but one, and so "
            "on.",
     .default_text = "1"}};

using parallel::check_count;
using parallel::Tally;

// The children that have completed in this activation, and those that were skipped in this tick.
Tally& begin_tick(NodeContext& context, NodeIndex self) {
  Tally& tally = context.state<Tally>(self);
  if (context.first_tick(self)) tally = {};
  tally.begin_tick();
  return tally;
}

// -1 is all of them, and so on.
std::int64_t count_of(std::int64_t given, std::int64_t all) {
  return given >= 0 ? given : std::max(all + given + 1, std::int64_t{0});
}

std::optional<RuleBreak> parallel_rule(const ParameterValues& given) {
  if (auto broken = check_count(given, kSuccessCount, "success_count")) return broken;
  return check_count(given, kFailureCount, "failure_count");
}

std::optional<RuleBreak> all_rule(const ParameterValues& given) {
  return check_count(given, kMaxFailures, "max_failures");
}

// Running: also of one that has completed before.
Status tick_unless_over(NodeContext& context, NodeIndex child) {
  return is_complete(context.status(child)) ? Status::Running : context.tick(child);
}

// Decides after each child, so that those to the right of the one that decides are not ticked. The
// counts wanted may be others than in the last tick.
Status tick_parallel(NodeContext& context, NodeIndex self) {
  Tally& tally = begin_tick(context, self);
  const std::int64_t all = context.node(self).children;
  const NodeIndex end = context.end_of(self);
  bool may_decide = true;
  for (NodeIndex next = self + 1; next != end;) {
    auto [child, status] = may_decide ? LeafLoop::Stop{next, Status::Idle}
                                      : LeafLoop::tick<Status::Running>(context, next, end);
    if (child == end) break;
    next = context.end_of(child);
    if (status == Status::Idle) status = tick_unless_over(context, child);
    if (context.faulted()) return Status::Running;
    if (status != Status::Running) {
      may_decide = true;
      tally.add(status);
    }
    if (!std::exchange(may_decide, false)) continue;
    const std::int64_t given = context.parameter(self, kSuccessCount).integer;
    const std::int64_t wanted = count_of(given, all);
    const std::int64_t failures = count_of(context.parameter(self, kFailureCount).integer, all);
    const std::int64_t counted =
        tally.of(Status::Success) + (given < 0 ? tally.of(Status::Skipped) : 0);
    const bool success = counted >= wanted;
    if (success || all - tally.of(Status::Failure) < wanted ||
        tally.of(Status::Failure) == failures) {
      context.halt_running_children(self);
      return success ? Status::Success : Status::Failure;
    }
  }
  return tally.of(Status::Skipped) == all ? Status::Skipped : Status::Running;
}

Status tick_all(NodeContext& context, NodeIndex self) {
  Tally& tally = begin_tick(context, self);
  const std::int64_t all = context.node(self).children;
  const NodeIndex end = context.end_of(self);
  for (NodeIndex next = self + 1; next != end;) {
    const auto [child, status] = LeafLoop::tick<Status::Running>(context, next, end);
    if (child == end) break;
    next = context.end_of(child);
    tally.add(status == Status::Idle ? tick_unless_over(context, child) : status);
  }
  if (context.faulted()) return Status::Running;
  if (tally.of(Status::Skipped) == all) return Status::Skipped;
  if (tally.of(Status::Success) + tally.of(Status::Failure) + tally.of(Status::Skipped) < all)
    return Status::Running;
  const std::int64_t most = count_of(context.parameter(self, kMaxFailures).integer, all);
  return tally.of(Status::Failure) >= most ? Status::Failure : Status::Success;
}

double progress_of_parallel(NodeContext& context, NodeIndex self) {
  const std::int64_t all = context.node(self).children;
  const std::int64_t wanted = count_of(context.parameter(self, kSuccessCount).integer, all);
  return parallel::progress_of_mth(context, self, std::clamp(wanted, std::int64_t{1}, all));
}

void fold_parallel(NodeContext& context, NodeIndex self) {
  fold::dead_when_idle(context, self);
  context.state<Tally>(self).begin_tick();
}

// The least progress of the children that are there.
double least_progress(NodeContext& context, NodeIndex self) {
  double least = 1.0;
  for (NodeIndex child = self + 1; child != context.end_of(self); child = context.end_of(child)) {
    if (context.activity(child) == Activity::Skipped) continue;
    if (context.status(child) != Status::Failure) least = std::min(least, context.progress(child));
  }
  return least;
}

}  // namespace

const NodeKind kParallel{
    .type = {.id = "Parallel",
             .category = NodeCategory::Control,
             .doc = "Ticks all children that have not completed. Success when success_count of "
                    "them succeeded, Failure when failure_count failed or success can no longer "
                    "be reached; the children that still run are then halted.",
             .arity = {1},
             .parameters = kParallelParameters,
             .rule = parallel_rule,
             .sign = "⇉",
             .latches = true},
    .tick = tick_parallel,
    .progress = progress_of_parallel,
    .state_size = sizeof(Tally),
    .state_per_child = sizeof(double),
    .fold = fold_parallel};

const NodeKind kParallelAll{.type = {.id = "ParallelAll",
                                     .category = NodeCategory::Control,
                                     .doc = "Ticks its children until all have completed. Failure "
                                            "when max_failures of them failed, otherwise Success.",
                                     .arity = {1},
                                     .parameters = kAllParameters,
                                     .rule = all_rule,
                                     .sign = "⇉",
                                     .latches = true},
                            .tick = tick_all,
                            .progress = least_progress,
                            .state_size = sizeof(Tally),
                            .fold = fold_parallel};

}  // namespace lockstep::host::btcpp
