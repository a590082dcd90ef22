#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep {
namespace {

constexpr unsigned kAttempts = 0;

constexpr Parameter kRetryParameters[] = {
    {.name = "attempts",
     .type = ValueType::Int,
     .doc = "How often the child may fail before this node does.",
     .required = true,
     .range = {.min = 1}},
};

struct RetryState {
  std::int64_t failed;
};

Status tick_retry(NodeContext& context, NodeIndex self) {
  RetryState& state = context.state<RetryState>(self);
  if (context.first_tick(self)) state.failed = 0;
  const Status status = context.tick(self + 1);
  if (status != Status::Failure) return status;
  ++state.failed;
  return state.failed == context.parameter(self, kAttempts).integer ? Status::Failure
                                                                    : Status::Running;
}

Round round_of_retry(NodeContext& context, NodeIndex self) {
  return {context.state<RetryState>(self).failed + 1, context.parameter(self, kAttempts).integer};
}

}  // namespace

const NodeKind kRetry{
    .type = {.id = "Retry",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it succeeds, at most a number of attempts, once per "
                    "tick.",
             .arity = {1, 1},
             .parameters = kRetryParameters,
             .can_run = true},
    .tick = tick_retry,
    .progress = decorator::child_progress,
    .state_size = sizeof(RetryState),
    .fold = fold::dead_when_idle,
    .round = round_of_retry};

}  // namespace lockstep
