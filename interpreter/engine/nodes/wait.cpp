#include <algorithm>

#include "engine/nodes/kinds.h"
#include "engine/ticker.h"

namespace lockstep {
namespace {

constexpr unsigned kSeconds = 0;

constexpr Parameter kParameters[] = {
    {.name = "seconds",
     .type = ValueType::Double,
     .doc = "How long to wait; the time during which it is paused does not count.",
     .required = true,
     .unit = "s",
     .range = {.min = 0, .max = 1e9}},
};

struct State {
  Nanoseconds start;
  Nanoseconds paused_at;
};

Nanoseconds duration(const Ticker& ticker, NodeIndex self) {
  return from_seconds(ticker.parameter(self, kSeconds).number);
}

Status tick(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  if (ticker.first_tick(self)) state.start = ticker.now();
  if (ticker.activity(self) == Activity::Paused) state.start += ticker.now() - state.paused_at;
  return ticker.now() - state.start < duration(ticker, self) ? Status::Running : Status::Success;
}

void pause(Ticker& ticker, NodeIndex self) {
  ticker.state<State>(self).paused_at = ticker.now();
}

double progress(Ticker& ticker, NodeIndex self) {
  const State& state = ticker.state<State>(self);
  const bool paused = ticker.activity(self) == Activity::Paused;
  const Nanoseconds elapsed = (paused ? state.paused_at : ticker.now()) - state.start;
  return std::min(1.0, to_seconds(elapsed) / to_seconds(duration(ticker, self)));
}

}  // namespace

const NodeKind kWait{.type = {.id = "Wait",
                              .category = NodeCategory::Action,
                              .doc = "Running for a time, then Success.",
                              .arity = {0, 0},
                              .parameters = kParameters,
                              .can_run = true},
                     .tick = tick,
                     .progress = progress,
                     .state_size = sizeof(State),
                     .pause = pause};

}  // namespace lockstep
