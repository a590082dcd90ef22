// Parallel and ParallelAll of BehaviorTree.CPP. A child that completed is not ticked again in the
// activation; its status says so.
#include <algorithm>
#include <optional>
#include <string>

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

struct Tally {
  std::int64_t all, succeeded = 0, failed = 0, skipped = 0;

  void add(Status status) {
    succeeded += status == Status::Success;
    failed += status == Status::Failure;
    skipped += status == Status::Skipped;
  }
};

// Of those that completed in earlier ticks of the activation.
Tally tally_of(Ticker& ticker, NodeIndex self) {
  Tally tally{ticker.node(self).children};
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    if (is_complete(ticker.status(child))) tally.add(ticker.status(child));
  }
  return tally;
}

// -1 is all of them, and so on.
std::int64_t count_of(std::int64_t given, std::int64_t all) {
  return given >= 0 ? given : std::max(all + given + 1, std::int64_t{0});
}

std::optional<RuleBreak> check_count(const ParameterValues& given, unsigned place,
                                     std::string_view name) {
  const auto* count = std::get_if<std::int64_t>(&given.values[place]);
  if (count == nullptr || given.children == 0 || *count <= given.children) return std::nullopt;
  const std::string most = std::to_string(given.children);
  return RuleBreak{static_cast<int>(place),
                   "'" + std::string(name) + "' is more than the " + most + " children of the node",
                   "give at most " + most};
}

std::optional<RuleBreak> parallel_rule(const ParameterValues& given) {
  if (auto broken = check_count(given, kSuccessCount, "success_count")) return broken;
  return check_count(given, kFailureCount, "failure_count");
}

std::optional<RuleBreak> all_rule(const ParameterValues& given) {
  return check_count(given, kMaxFailures, "max_failures");
}

// After each child, so that those to the right of the one that decides are not ticked.
Status tick_parallel(Ticker& ticker, NodeIndex self) {
  Tally tally = tally_of(ticker, self);
  const std::int64_t given = ticker.parameter(self, kSuccessCount).integer;
  const std::int64_t wanted = count_of(given, tally.all);
  const std::int64_t failures = count_of(ticker.parameter(self, kFailureCount).integer, tally.all);
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    if (!is_complete(ticker.status(child))) tally.add(ticker.tick(child));
    if (ticker.faulted()) return Status::Running;
    const std::int64_t counted = tally.succeeded + (given < 0 ? tally.skipped : 0);
    const bool success = counted >= wanted;
    if (success || tally.all - tally.failed < wanted || tally.failed == failures) {
      ticker.halt_running_children(self);
      return success ? Status::Success : Status::Failure;
    }
  }
  return tally.skipped == tally.all ? Status::Skipped : Status::Running;
}

Status tick_all(Ticker& ticker, NodeIndex self) {
  Tally tally = tally_of(ticker, self);
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    if (!is_complete(ticker.status(child))) tally.add(ticker.tick(child));
  }
  if (ticker.faulted()) return Status::Running;
  if (tally.skipped == tally.all) return Status::Skipped;
  if (tally.succeeded + tally.failed + tally.skipped < tally.all) return Status::Running;
  const std::int64_t most = count_of(ticker.parameter(self, kMaxFailures).integer, tally.all);
  return tally.failed >= most ? Status::Failure : Status::Success;
}

double progress_of_parallel(Ticker& ticker, NodeIndex self) {
  const std::int64_t all = ticker.node(self).children;
  const std::int64_t wanted = count_of(ticker.parameter(self, kSuccessCount).integer, all);
  return parallel::progress_of_mth(ticker, self, std::clamp(wanted, std::int64_t{1}, all));
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
    .state_per_child = sizeof(double)};

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
    .progress = least_progress};

}  // namespace lockstep::btcpp
