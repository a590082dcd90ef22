#pragma once

#include <cstdint>

namespace lockstep::host {

// The ticks from the first to the last, both with it.
struct TickRange {
  std::uint64_t from = 0, to = UINT64_MAX;

  bool is_all() const { return from == 0 && to == UINT64_MAX; }
};

}  // namespace lockstep::host
