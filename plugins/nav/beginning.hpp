// The last tick of a node. One that goes on from there begins again when it was not ticked in the
// tick before: its parent has done something else meanwhile.
#pragma once

#include <cstdint>
#include <optional>

namespace nav {

class LastTick {
 public:
  // Notes a tick. Whether the node was not ticked in the tick before. A run that is late leaves out
  // ticks, and their numbers with them.
  bool is_after_gap(std::uint64_t number) {
    const bool is_gap = !last_ || number > *last_ + 1;
    last_ = number;
    return is_gap;
  }

 private:
  std::optional<std::uint64_t> last_;
};

inline constexpr double kRounding = 1e-9;  // of a sum of ticks

}  // namespace nav
