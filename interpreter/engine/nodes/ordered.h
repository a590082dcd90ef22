// The common tick of Sequence and Fallback: tick children from the left and stop at the first that
// does not return `kGoOn`. Included by those two files only.
#pragma once

#include "engine/ticker.h"

namespace lockstep::ordered {

struct State {
  NodeIndex current;   // the child at which the last tick stopped
  std::uint32_t done;  // how many children are before it
};

inline constexpr Parameter kParameters[] = {
    {.name = "memory",
     .type = ValueType::Bool,
     .doc = "Do not tick again the children that already completed in this activation.",
     .default_text = "false",
     .constant = true},
};

template <Status kGoOn>
Status tick(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  const NodeIndex end = ticker.end_of(self);
  const bool first = ticker.first_tick(self);
  const NodeIndex previous = first ? self : state.current;
  const bool resume = !first && ticker.parameter(self, 0).boolean;
  NodeIndex child = resume ? state.current : self + 1;
  std::uint32_t done = resume ? state.done : 0;
  for (; child != end; child = ticker.end_of(child), ++done) {
    const Status status = ticker.tick(child);
    if (status == kGoOn) continue;
    if (child < previous) ticker.halt_range(ticker.end_of(child), ticker.end_of(previous));
    state = {child, done};
    return status;
  }
  return kGoOn;
}

}  // namespace lockstep::ordered
