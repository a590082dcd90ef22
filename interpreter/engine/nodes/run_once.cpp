// RunOnce of both languages.
#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep {
namespace {

constexpr unsigned kThenSkip = 0;

constexpr Parameter kRunOnceParameters[] = {
    {.name = "then_skip",
     .type = ValueType::Bool,
     .doc = "Be skipped once the child has completed; else return its result again.",
     .default_text = "true"}};

// Not cleared by a new activation: once means once in a run.
struct RunOnceState {
  Status result;  // Idle: not yet completed
};

Status tick_once(NodeContext& context, NodeIndex self, RunOnceState& state) {
  const Status status = context.tick(self + 1);
  if (is_complete(status)) state.result = status;
  return status;
}

Status tick_run_once(NodeContext& context, NodeIndex self) {
  RunOnceState& state = context.state<RunOnceState>(self);
  return is_complete(state.result) ? state.result : tick_once(context, self, state);
}

Status tick_or_skip(NodeContext& context, NodeIndex self) {
  RunOnceState& state = context.state<RunOnceState>(self);
  const bool skips = is_complete(state.result) && context.parameter(self, kThenSkip).boolean;
  return skips ? Status::Skipped : tick_run_once(context, self);
}

}  // namespace

const NodeKind kRunOnce{
    .type = {.id = "RunOnce",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it has completed once in this run; from then on returns "
                    "that result without ticking it.",
             .arity = {1, 1},
             .begins_child_once = true,
             .acts_again = false},
    .tick = tick_run_once,
    .progress = decorator::child_progress,
    .state_size = sizeof(RunOnceState),
    .fold = fold::live};

const NodeKind btcpp::kRunOnce{
    .type = {.id = "RunOnce",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it has completed once in this run; from then on it is "
                    "skipped, or returns that result again.",
             .arity = {1, 1},
             .parameters = kRunOnceParameters,
             .acts_again = false},
    .tick = tick_or_skip,
    .progress = decorator::child_progress,
    .state_size = sizeof(RunOnceState),
    .fold = fold::live};

}  // namespace lockstep
