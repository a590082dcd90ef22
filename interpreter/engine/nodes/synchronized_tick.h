// The tick that ParallelAbsolute and ParallelRelative share (Colledanchise and Natale, "Analysis
// and Exploitation of Synchronized Parallel Executions in Behavior Trees", algorithms 1 and 2).
// They differ only in who is held: which children may not advance in this tick.
#pragma once

#include <algorithm>

#include "engine/synchronized.h"
#include "engine/ticker.h"

namespace lockstep::synchronized {

// One snapshot before any child is ticked; returns its minimum. A child that succeeded counts as 1.
inline double take_snapshot(Ticker& ticker, NodeIndex self) {
  double least = 1.0;
  NodeIndex child = self + 1;
  for (double& number : ticker.child_numbers(self)) {
    number = ticker.progress(child);
    least = std::min(least, number);
    child = ticker.end_of(child);
  }
  return least;
}

// `held(progress)` says of a child with that progress whether ticks are withheld from it.
template <class Held>
Status tick_each(Ticker& ticker, NodeIndex self, Held held) {
  const auto snapshot = ticker.child_numbers(self);
  std::uint32_t succeeded = 0;
  bool failed = false;
  NodeIndex child = self + 1;
  for (const double reached : snapshot) {
    if (ticker.faulted()) return Status::Running;
    Status status = ticker.status(child);
    if (!is_complete(status)) {
      if (!held(reached)) {
        status = ticker.tick(child);
      } else if (ticker.activity(child) == Activity::Running) {
        ticker.pause(child);
      }
    }
    succeeded += status == Status::Success;
    failed |= status == Status::Failure;
    child = ticker.end_of(child);
  }
  if (succeeded == snapshot.size()) return Status::Success;
  if (!failed) return Status::Running;
  ticker.halt_running_children(self);
  return Status::Failure;
}

template <class Held>
Status tick_children(Ticker& ticker, NodeIndex self, Held held) {
  const Status status = tick_each(ticker, self, held);
  ticker.state<SynchronizedState>(self).succeeded = status == Status::Success;
  return status;
}

// So that synchronized nodes nest: the least progressed child.
inline double progress(Ticker& ticker, NodeIndex self) {
  double least = 1.0;
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    least = std::min(least, ticker.progress(child));
  }
  return least;
}

}  // namespace lockstep::synchronized
