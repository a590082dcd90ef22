// The tick that ParallelAbsolute and ParallelRelative share (Colledanchise and Natale, "Analysis
// and Exploitation of Synchronized Parallel Executions in Behavior Trees", algorithms 1 and 2).
// They differ only in which children are held in a tick.
#pragma once

#include <algorithm>

#include "engine/nodes/parallel_rule.h"
#include "engine/synchronized.h"

namespace lockstep::host::synchronized {

// One snapshot before any child is ticked; returns its minimum.
inline double take_snapshot(NodeContext& context, NodeIndex self) {
  double least = 1.0;
  NodeIndex child = self + 1;
  for (double& number : context.child_states<double>(self)) {
    number = snapshot_of(context, child);
    if (number < least) least = number;
    child = context.end_of(child);
  }
  return least;
}

// `held(progress)` returns whether a child with that progress is held. A guard is never held.
template <class Held>
Status tick_each(NodeContext& context, NodeIndex self, const parallel::Counts& counts, Held held) {
  parallel::Tally tally;
  NodeIndex child = self + 1;
  for (const double reached : context.child_states<double>(self)) {
    if (context.faulted()) return Status::Running;
    Status status = context.status(child);
    if (!parallel::is_over(context, child)) {
      if (!held(reached) || context.is_guard(child) || !context.hold(child)) {
        status = context.tick(child);
      }
    }
    tally.add(status);
    child = context.end_of(child);
  }
  return context.faulted() ? Status::Running : parallel::judge(context, self, counts, tally);
}

template <class Held>
Status tick_children(NodeContext& context, NodeIndex self, const parallel::Counts& counts,
                     Held held) {
  const Status status = tick_each(context, self, counts, held);
  context.state<SynchronizedState>(self).succeeded = status == Status::Success;
  return status;
}

// What measures see of a node that a script has decided before it began: its children are as far as
// it is.
inline void decided(NodeContext& context, NodeIndex self, Status result) {
  const bool succeeded = result == Status::Success;
  std::ranges::fill(context.child_states<double>(self), succeeded ? 1.0 : 0.0);
  context.state<SynchronizedState>(self).succeeded = succeeded;
}

// The progress of the least progressed child, so that synchronized nodes can be nested.
inline double least_progress(NodeContext& context, NodeIndex self) {
  double least = 1.0;
  for (NodeIndex child = self + 1; child != context.end_of(self); child = context.end_of(child)) {
    if (const double number = snapshot_of(context, child); number < least) least = number;
  }
  return least;
}

}  // namespace lockstep::host::synchronized
