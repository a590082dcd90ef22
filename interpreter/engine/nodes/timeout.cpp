#include "engine/nodes/decorator.h"

namespace lockstep {
namespace {

constexpr unsigned kSeconds = 0;

constexpr Parameter kParameters[] = {
    {.name = "seconds",
     .type = ValueType::Double,
     .doc = "How long the child may run, counted from its first tick.",
     .required = true,
     .unit = "s",
     .range = {.min = 0, .max = 1e9, .min_excluded = true}},
};

struct State {
  Nanoseconds start;
};

Status tick(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  if (ticker.first_tick(self)) state.start = ticker.now();
  if (ticker.now() - state.start < from_seconds(ticker.parameter(self, kSeconds).number)) {
    return ticker.tick(self + 1);
  }
  ticker.halt(self + 1);
  return Status::Failure;
}

}  // namespace

const NodeKind kTimeout{
    .type = {.id = "Timeout",
             .category = NodeCategory::Decorator,
             .doc = "Failure, and its child is halted, when the child still runs after a time.",
             .arity = {1, 1},
             .parameters = kParameters},
    .tick = tick,
    .progress = decorator::child_progress,
    .state_size = sizeof(State)};

}  // namespace lockstep
