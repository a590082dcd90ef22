// The tick that ParallelAbsolute and ParallelRelative share (Colledanchise and Natale, "Analysis
// and Exploitation of Synchronized Parallel Executions in Behavior Trees", algorithms 1 and 2).
// They differ only in which children are held in a tick.
#pragma once

#include "engine/leaf_loop.h"
#include "engine/nodes/parallel_rule.h"
#include "engine/synchronized.h"

namespace lockstep::host::synchronized {

// One snapshot before any child is ticked; returns its minimum, 1 if all were left out.
inline double take_snapshot(NodeContext& context, NodeIndex self) {
  const NodeIndex end = context.end_of(self);
  double* number = context.child_states<double>(self).data();
  double least = 1.0;
  for (NodeIndex child = self + 1; child != end; child = context.end_of(child), ++number) {
    const NodeIndex stop = LeafLoop::read_progress(context, child, end, number, least);
    number += stop - child;
    child = stop;
    if (child == end) break;
    *number = snapshot_of(context, child);
    if (*number < least) least = *number;
  }
  return least;
}

// A child is held whose progress is not less than `held_from`, but never a guard.
inline Status tick_children(NodeContext& context, NodeIndex self, const parallel::Counts& counts,
                            double held_from) {
  parallel::Tally tally;
  const NodeIndex end = context.end_of(self);
  const double* reached = context.child_states<double>(self).data();
  for (NodeIndex child = self + 1; child != end; ++reached) {
    auto [stop, status] = LeafLoop::tick_below(context, child, end, reached, held_from);
    if (stop == end) break;
    reached += stop - child;
    child = context.end_of(stop);
    if (context.faulted()) return Status::Running;
    if (status == Status::Idle) {
      const bool is_over = parallel::is_over(context, stop) ||
                           (*reached >= held_from && !context.is_guard(stop) && context.hold(stop));
      status = is_over ? context.status(stop) : context.tick(stop);
    }
    tally.add(status);
  }
  return context.faulted() ? Status::Running : parallel::judge(context, self, counts, tally);
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
