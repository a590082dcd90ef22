// The tick that ParallelAbsolute and ParallelRelative share (Colledanchise and Natale, "Analysis
// and Exploitation of Synchronized Parallel Executions in Behavior Trees", algorithms 1 and 2).
// They differ only in which children are held in a tick.
#pragma once

#include <algorithm>

#include "engine/nodes/parallel_rule.h"
#include "engine/synchronized.h"

namespace lockstep::synchronized {

// One snapshot before any child is ticked; returns its minimum.
inline double take_snapshot(Ticker& ticker, NodeIndex self) {
  double least = 1.0;
  NodeIndex child = self + 1;
  for (double& number : ticker.child_numbers(self)) {
    number = snapshot_of(ticker, child);
    if (number < least) least = number;
    child = ticker.end_of(child);
  }
  return least;
}

// `held(progress)` returns whether a child with that progress is held. A guard is never held.
template <class Held>
Status tick_each(Ticker& ticker, NodeIndex self, const parallel::Places& places, Held held) {
  parallel::Tally tally;
  NodeIndex child = self + 1;
  for (const double reached : ticker.child_numbers(self)) {
    if (ticker.faulted()) return Status::Running;
    Status status = ticker.status(child);
    if (!parallel::is_over(ticker, child)) {
      if (!held(reached) || ticker.is_guard(child) || !ticker.hold(child)) {
        status = ticker.tick(child);
      }
    }
    tally.add(status);
    child = ticker.end_of(child);
  }
  return ticker.faulted() ? Status::Running : parallel::judge(ticker, self, places, tally);
}

template <class Held>
Status tick_children(Ticker& ticker, NodeIndex self, const parallel::Places& places, Held held) {
  const Status status = tick_each(ticker, self, places, held);
  ticker.state<SynchronizedState>(self).succeeded = status == Status::Success;
  return status;
}

// What measures see of a node that a script has decided before it began: its children are as far as
// it is.
inline void decided(Ticker& ticker, NodeIndex self, Status result) {
  const bool succeeded = result == Status::Success;
  std::ranges::fill(ticker.child_numbers(self), succeeded ? 1.0 : 0.0);
  ticker.state<SynchronizedState>(self).succeeded = succeeded;
}

// The progress of the least progressed child, so that synchronized nodes can be nested.
inline double least_progress(Ticker& ticker, NodeIndex self) {
  double least = 1.0;
  for (NodeIndex child = self + 1; child != ticker.end_of(self); child = ticker.end_of(child)) {
    if (const double number = snapshot_of(ticker, child); number < least) least = number;
  }
  return least;
}

}  // namespace lockstep::synchronized
