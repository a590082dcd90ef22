// RunOnce of both languages.
#include "engine/nodes/decorator.h"

namespace lockstep {
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

Status tick_once(Ticker& ticker, NodeIndex self, State& state) {
  const Status status = ticker.tick(self + 1);
  if (is_complete(status)) state.result = status;
  return status;
}

Status tick(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  return is_complete(state.result) ? state.result : tick_once(ticker, self, state);
}

Status tick_or_skip(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  const bool skips = is_complete(state.result) && ticker.parameter(self, kThenSkip).boolean;
  return skips ? Status::Skipped : tick(ticker, self);
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

const NodeKind btcpp::kRunOnce{
    .type = {.id = "RunOnce",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it has completed once in this run; from then on it is "
                    "skipped, or returns that result again.",
             .arity = {1, 1},
             .parameters = kParameters,
             .acts_again = false},
    .tick = tick_or_skip,
    .progress = decorator::child_progress,
    .state_size = sizeof(State)};

}  // namespace lockstep
