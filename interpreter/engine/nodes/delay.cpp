#include "engine/nodes/decorator.h"

namespace lockstep {
namespace {

constexpr unsigned kSeconds = 0;

constexpr Parameter kParameters[] = {
    {.name = "seconds",
     .type = ValueType::Double,
     .doc = "How long to wait before the child is ticked.",
     .required = true,
     .unit = "s",
     .range = {.min = 0, .max = 1e9}},
};

struct State {
  Nanoseconds start;
};

Status tick(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  if (ticker.first_tick(self)) state.start = ticker.now();
  if (ticker.now() - state.start < from_seconds(ticker.parameter(self, kSeconds).number)) {
    return Status::Running;
  }
  return ticker.tick(self + 1);
}

}  // namespace

const NodeKind kDelay{
    .type = {.id = "Delay",
             .category = NodeCategory::Decorator,
             .doc = "Running for a time, then ticks its child and returns what it returns.",
             .arity = {1, 1},
             .parameters = kParameters},
    .tick = tick,
    .progress = decorator::child_progress,
    .state_size = sizeof(State)};

}  // namespace lockstep
