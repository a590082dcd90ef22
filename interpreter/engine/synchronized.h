// What a synchronized parallel says of itself: the one source for measures, views and recordings.
#pragma once

#include <span>

#include "engine/ticker.h"

namespace lockstep {

// The state of a synchronized node, with the progress of each child behind it (child_numbers).
struct SynchronizedState {
  double limit;    // of the last tick: the current barrier, or the least progress + delta
  bool succeeded;  // in the last tick
};

inline Synchronization synchronization(const Node& node) {
  return node.kind->type.synchronization;
}

// How far a child could be without being held in the node's last tick: the current barrier, or the
// least progress plus delta. Infinity when no barrier is left.
inline double limit(Ticker& ticker, NodeIndex node) {
  return ticker.state<SynchronizedState>(node).limit;
}

// The progress of each child at the start of its parallel's last tick, as the node used it: 1 for a
// child that has succeeded. Only for synchronized nodes; valid until the next tick.
inline std::span<const double> child_progress(Ticker& ticker, NodeIndex node) {
  return ticker.child_numbers(node);
}

// Of a synchronized node that the last tick reached: whether it has succeeded in it, also when an
// ancestor that ended in the same tick has made it idle again.
inline bool succeeded(Ticker& ticker, NodeIndex node) {
  return ticker.state<SynchronizedState>(node).succeeded;
}

// ParallelAbsolute: its barriers, rising. Else, and where an entry gives them: empty.
std::span<const double> barriers(const Tree& tree, NodeIndex node);
// ParallelRelative only; 0 where an entry gives it.
double delta(const Tree& tree, NodeIndex node);

}  // namespace lockstep
