#include <algorithm>
#include <functional>
#include <string>

#include "engine/nodes/kinds.h"
#include "engine/ticker.h"

namespace lockstep {
namespace {

constexpr unsigned kSuccessCount = 0;
constexpr unsigned kFailureCount = 1;

constexpr Parameter kParameters[] = {
    {.name = "success_count",
     .type = ValueType::Int,
     .doc = "How many children must succeed for Success; all when absent.",
     .range = {.min = 1}},
    {.name = "failure_count",
     .type = ValueType::Int,
     .doc = "How many children must fail for Failure.",
     .default_text = "1",
     .range = {.min = 1}},
};

std::optional<RuleBreak> rule(const ParameterValues& given) {
  const std::uint32_t children = given.children;
  const std::int64_t all = children;
  if (!given.is_given(kSuccessCount)) given.values[kSuccessCount] = all;
  for (const unsigned parameter : {kSuccessCount, kFailureCount}) {
    const auto* count = std::get_if<std::int64_t>(&given.values[parameter]);
    if (count == nullptr || *count <= all) continue;
    return RuleBreak{static_cast<int>(parameter),
                     "'" + std::string(kParameters[parameter].name) + "' is more than the " +
                         std::to_string(children) + " children of the node",
                     "give at most " + std::to_string(children)};
  }
  return std::nullopt;
}

Status tick(Ticker& ticker, NodeIndex self) {
  const Node& node = ticker.node(self);
  std::int64_t succeeded = 0;
  std::int64_t failed = 0;
  for (NodeIndex child = self + 1; child != node.end; child = ticker.end_of(child)) {
    Status status = ticker.status(child);
    if (!is_complete(status)) status = ticker.tick(child);
    succeeded += status == Status::Success;
    failed += status == Status::Failure;
  }
  const std::int64_t wanted = ticker.parameter(self, kSuccessCount).integer;
  const bool success = succeeded >= wanted;
  const bool failure =
      failed >= ticker.parameter(self, kFailureCount).integer || node.children - failed < wanted;
  if (!success && !failure) return Status::Running;
  ticker.halt_running_children(self);
  return success ? Status::Success : Status::Failure;
}

// The M-th largest of the children: the point at which M of them will have arrived.
double progress(Ticker& ticker, NodeIndex self) {
  const auto sorted = ticker.child_numbers(self);
  NodeIndex child = self + 1;
  for (double& number : sorted) {
    number = ticker.progress(child);
    child = ticker.end_of(child);
  }
  const auto wanted = sorted.begin() + (ticker.parameter(self, kSuccessCount).integer - 1);
  std::nth_element(sorted.begin(), wanted, sorted.end(), std::greater<>());
  const double reached = *wanted;
  std::fill(sorted.begin(), sorted.end(), 0.0);  // asking must not change the state
  return reached;
}

}  // namespace

const NodeKind kParallel{
    .type = {.id = "Parallel",
             .category = NodeCategory::Control,
             .doc = "Ticks all children that have not completed. Success when success_count of "
                    "them succeeded; Failure when failure_count failed, or when success can no "
                    "longer be reached. The children that still run are then halted.",
             .arity = {1},
             .parameters = kParameters,
             .rule = rule,
             .sign = "⇉"},
    .tick = tick,
    .progress = progress,
    .state_per_child = sizeof(double)};

}  // namespace lockstep
