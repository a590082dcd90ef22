#include "engine/nodes/decorator.h"

namespace lockstep::btcpp {
namespace {

constexpr unsigned kThenSkip = 0;

constexpr Parameter kParameters[] = {
    {.name = "then_skip",
     .type = ValueType::Bool,
     .doc = "Be skipped once the child has completed; else return its result again.",
     .default_text = "true"}};

// Not cleared by a new activation: once means once in a run.
struct State {
  Status result;  // Idle: not yet completed
};

Status tick(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  if (is_complete(state.result)) {
    return ticker.parameter(self, kThenSkip).boolean ? Status::Skipped : state.result;
  }
  const Status status = ticker.tick(self + 1);
  if (is_complete(status)) state.result = status;
  return status;
}

}  // namespace

const NodeKind kRunOnce{
    .type = {.id = "RunOnce",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it has completed once in this run; from then on it is "
                    "skipped, or returns that result again.",
             .arity = {1, 1},
             .parameters = kParameters,
             .acts_again = false},
    .tick = tick,
    .progress = decorator::child_progress,
    .state_size = sizeof(State)};

}  // namespace lockstep::btcpp
