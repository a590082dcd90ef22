#include "engine/nodes/decorator.h"

namespace lockstep {
namespace {

// Not cleared by a new activation: once means once in a run.
struct State {
  Status result;  // Idle: not yet completed
};

Status tick(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  if (is_complete(state.result)) return state.result;
  const Status status = ticker.tick(self + 1);
  if (is_complete(status)) state.result = status;
  return status;
}

}  // namespace

const NodeKind kRunOnce{
    .type = {.id = "RunOnce",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it has completed once in this run; from then on returns "
                    "that result without ticking it.",
             .arity = {1, 1},
             .acts_again = false},
    .tick = tick,
    .progress = decorator::child_progress,
    .state_size = sizeof(State)};

}  // namespace lockstep
