// Numbers of children, as parallels are given them.
#pragma once

#include <algorithm>
#include <cstddef>

namespace BT::lockstep_detail {

// -1: all children, -2: all but one, and so on.
inline std::size_t count_of(int given, std::size_t children) {
  if (given >= 0) return static_cast<std::size_t>(given);
  return static_cast<std::size_t>(std::max(static_cast<long long>(children) + given + 1, 0LL));
}

}  // namespace BT::lockstep_detail
