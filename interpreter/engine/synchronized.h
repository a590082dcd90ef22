// What a synchronized parallel shows of itself, for measures, views and recordings.
#pragma once

#include <span>

#include "engine/ticker.h"

namespace lockstep {

inline Synchronization synchronization(const Node& node) {
  return node.kind->type.synchronization;
}

// The progress of each child at the start of its parallel's last tick, as the node used it: 1 for a
// child that has succeeded. Only for synchronized nodes; valid until the next tick.
std::span<const double> child_progress(Ticker& ticker, NodeIndex node);

// Of a synchronized node that the last tick reached: whether it has succeeded in it, also when an
// ancestor that ended in the same tick has made it idle again.
bool succeeded(Ticker& ticker, NodeIndex node);

// ParallelAbsolute: its barriers, rising. ParallelRelative: empty.
std::span<const double> barriers(const Tree& tree, NodeIndex node);
// ParallelRelative only.
double delta(const Tree& tree, NodeIndex node);

}  // namespace lockstep
