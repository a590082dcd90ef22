// Parallel and ParallelAll of BehaviorTree.CPP. A child that completed is not ticked again in the
// activation; its status says so.
#include <algorithm>
#include <optional>
#include <utility>

#include "engine/nodes/fold.h"
#include "engine/nodes/kinds.h"
#include "engine/nodes/parallel_rule.h"

namespace lockstep::btcpp {
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
Tally& begin_tick(Ticker& ticker, NodeIndex self) {
  Tally& tally = ticker.state<Tally>(self);
  if (ticker.first_tick(self)) tally = {};
  tally.skipped = 0;
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

// Decides after each child, so that those to the right of the one that decides are not ticked. The
// counts wanted may be others than in the last tick.
Status tick_parallel(Ticker& ticker, NodeIndex self) {
  Tally& tally = begin_tick(ticker, self);
  const std::int64_t all = ticker.node(self).children;
  bool may_decide = true;
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    if (!is_complete(ticker.status(child))) {
      const Status status = ticker.tick(child);
      if (ticker.faulted()) return Status::Running;
      if (status != Status::Running) {
        may_decide = true;
        tally.add(status);
      }
    }
    if (!std::exchange(may_decide, false)) continue;
    const std::int64_t given = ticker.parameter(self, kSuccessCount).integer;
    const std::int64_t wanted = count_of(given, all);
    const std::int64_t failures = count_of(ticker.parameter(self, kFailureCount).integer, all);
    const std::int64_t counted = tally.succeeded + (given < 0 ? tally.skipped : 0);
    const bool success = counted >= wanted;
    if (success || all - tally.failed < wanted || tally.failed == failures) {
      ticker.halt_running_children(self);
      return success ? Status::Success : Status::Failure;
    }
  }
  return tally.skipped == all ? Status::Skipped : Status::Running;
}

Status tick_all(Ticker& ticker, NodeIndex self) {
  Tally& tally = begin_tick(ticker, self);
  const std::int64_t all = ticker.node(self).children;
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    if (!is_complete(ticker.status(child))) tally.add(ticker.tick(child));
  }
  if (ticker.faulted()) return Status::Running;
  if (tally.skipped == all) return Status::Skipped;
  if (tally.succeeded + tally.failed + tally.skipped < all) return Status::Running;
  const std::int64_t most = count_of(ticker.parameter(self, kMaxFailures).integer, all);
  return tally.failed >= most ? Status::Failure : Status::Success;
}

double progress_of_parallel(Ticker& ticker, NodeIndex self) {
  const std::int64_t all = ticker.node(self).children;
  const std::int64_t wanted = count_of(ticker.parameter(self, kSuccessCount).integer, all);
  return parallel::progress_of_mth(ticker, self, std::clamp(wanted, std::int64_t{1}, all));
}

void fold_parallel(Ticker& ticker, NodeIndex self) {
  fold::dead_when_idle(ticker, self);
  ticker.state<Tally>(self).skipped = 0;
}

// Of the children that are there.
double least_progress(Ticker& ticker, NodeIndex self) {
  double least = 1.0;
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    if (ticker.activity(child) == Activity::Skipped) continue;
    if (ticker.status(child) != Status::Failure) least = std::min(least, ticker.progress(child));
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

const NodeKind kParallelAll{
    .type = {.id = "ParallelAll",
             .category = NodeCategory::Control,
             .doc = "Ticks its children until all have completed. Failure when max_failures of "
                    "them failed, else Success.",
             .arity = {1},
             .parameters = kAllParameters,
             .rule = all_rule,
             .sign = "⇉",
             .latches = true},
    .tick = tick_all,
    .progress = least_progress,
    .state_size = sizeof(Tally),
    .fold = fold_parallel};

}  // namespace lockstep::btcpp
