// The languages in which trees are written. Each has its own reader (definition/) and its own list
// of built-in nodes (engine/nodes/kinds.h); everything behind them is shared.
#pragma once

#include <cstdint>

namespace lockstep {

enum class Language : std::uint8_t {
  Lockstep,        // <root lockstep="1">
  BehaviorTreeCpp  // <root BTCPP_format="4">, and older files without a format
};

}  // namespace lockstep
