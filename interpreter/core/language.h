// The languages in which trees are written. Each has its own reader (definition/) and its own list
// of built-in nodes (engine/nodes/kinds.h); everything behind them is shared.
#pragma once

#include <cstdint>

namespace lockstep {

enum class Language : std::uint8_t {
  Lockstep,        // <root lockstep="1">
  BehaviorTreeCpp  // <root BTCPP_format="4">, and older files without a format
};

// The version of what trees mean: docs/language.md has what each has changed. Recordings name it.
inline constexpr std::uint64_t kLawVersion = 2;

}  // namespace lockstep
