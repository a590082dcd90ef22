// The common tick of Sequence, Fallback and their reactive forms: tick children from the left and
// stop at the first that does not return `kGoOn`. A child that is skipped counts as not there.
#pragma once

#include <cstdint>

#include "engine/ticker.h"

namespace lockstep::ordered {

struct State {
  NodeIndex current;      // the child at which the last tick stopped
  std::uint32_t done;     // how many children are before it
  std::uint32_t skipped;  // of those
};

inline constexpr Parameter kParameters[] = {
    {.name = "memory",
     .type = ValueType::Bool,
     .doc = "Do not tick again the children that already completed in this activation.",
     .default_text = "false",
     .constant = true},
};

// Whether children that have completed are ticked again.
enum class Memory : std::uint8_t { ByParameter, Always, Never };

template <Memory kMemory>
bool has_memory(const Ticker& ticker, NodeIndex self) {
  if constexpr (kMemory == Memory::ByParameter) return ticker.parameter(self, 0).boolean;
  return kMemory == Memory::Always;
}

template <Status kGoOn, Memory kMemory = Memory::ByParameter>
Status tick(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  const NodeIndex end = ticker.end_of(self);
  const bool first = ticker.first_tick(self);
  const NodeIndex previous = first ? self : state.current;
  const bool resume = !first && has_memory<kMemory>(ticker, self);
  NodeIndex child = resume ? state.current : self + 1;
  std::uint32_t done = resume ? state.done : 0;
  std::uint32_t skipped = resume ? state.skipped : 0;
  for (; child != end; child = ticker.end_of(child), ++done) {
    const Status status = ticker.tick(child);
    if (status == kGoOn) continue;
    if (status == Status::Skipped) {
      if (!has_memory<kMemory>(ticker, self)) ticker.forget_range(child, ticker.end_of(child));
      ++skipped;
      continue;
    }
    if (child < previous) ticker.halt_range(ticker.end_of(child), ticker.end_of(previous));
    state = {child, done, skipped};
    return status;
  }
  if (skipped != ticker.node(self).children) return kGoOn;
  ticker.forget_range(self + 1, end);
  return Status::Skipped;
}

inline double progress_of_sequence(Ticker& ticker, NodeIndex self) {
  const auto& state = ticker.state<State>(self);
  return (state.done + ticker.progress(state.current)) / ticker.node(self).children;
}

inline double progress_of_fallback(Ticker& ticker, NodeIndex self) {
  return ticker.progress(ticker.state<State>(self).current);
}

}  // namespace lockstep::ordered
