// What Delay and Timeout share: the time since the first tick of an activation, against `seconds`.
#pragma once

#include "engine/ticker.h"

namespace lockstep::timed {

inline constexpr unsigned kSeconds = 0;

struct State {
  Nanoseconds start;
};

// To be asked once in each tick.
inline bool is_over(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  if (ticker.first_tick(self)) state.start = ticker.now();
  return ticker.now() - state.start >= from_seconds(ticker.parameter(self, kSeconds).number);
}

}  // namespace lockstep::timed
