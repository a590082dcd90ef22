// The tick that ParallelAbsolute and ParallelRelative share (Colledanchise and Natale, "Analysis
// and Exploitation of Synchronized Parallel Executions in Behavior Trees", algorithms 1 and 2).
// They differ only in which children are held in a tick.
#pragma once

#include "engine/leaf_loop.h"
#include "engine/nodes/pacing.h"
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

// Of a node that paces. Behind it: the progress of each child, then what is kept of each.
struct PacedState {
  SynchronizedState synchronized;
  PacingState pacing;
};

inline std::span<PacedChild> paced_children(NodeContext& context, NodeIndex self) {
  const auto numbers = context.child_states<double>(self);
  return {reinterpret_cast<PacedChild*>(numbers.data() + numbers.size()), numbers.size()};
}

// How a child is ticked: as it is, or with its factor.
struct Plain {
  static constexpr bool kPaces = false;
};
struct Paced {
  static constexpr bool kPaces = true;
  const PacedChild* own;  // of the first child
};

// A child is held whose progress is not less than `held_from`, but never a guard.
template <class How>
Status tick_children(NodeContext& context, NodeIndex self, const parallel::Counts& counts,
                     double held_from, [[maybe_unused]] How how) {
  parallel::Tally tally;
  const NodeIndex end = context.end_of(self);
  const double* const first = context.child_states<double>(self).data();
  const double* reached = first;
  for (NodeIndex child = self + 1; child != end; ++reached) {
    auto [stop, status] = LeafLoop::tick_below(context, child, end, reached, held_from);
    if (stop == end) break;
    reached += stop - child;
    child = context.end_of(stop);
    if (context.faulted()) return Status::Running;
    if (status == Status::Idle) {
      const bool is_over = parallel::is_over(context, stop) ||
                           (*reached >= held_from && !context.is_guard(stop) && context.hold(stop));
      if (is_over) {
        status = context.status(stop);
      } else if constexpr (How::kPaces) {
        status = context.tick_at_pace(stop, how.own[reached - first].given);
      } else {
        status = context.tick(stop);
      }
    }
    tally.add(status);
  }
  return context.faulted() ? Status::Running : parallel::judge(context, self, counts, tally);
}

// How many children contain actions.
inline std::int64_t count_actions(const NodeContext& context, NodeIndex self) {
  std::int64_t count = 0;
  for (NodeIndex child = self + 1; child != context.end_of(self); child = context.end_of(child)) {
    count += context.is_guard(child) ? 0 : 1;
  }
  return count;
}

// Gives each child its factor. A node that ends before all of its children have come asks for
// nothing where the limit is not one at which they meet.
inline Paced set_paces(NodeContext& context, NodeIndex self, const parallel::Counts& counts,
                       double limit, double held_from, double reaction) {
  auto& state = context.state<PacedState>(self).pacing;
  const bool begins = context.first_tick(self);
  const Nanoseconds until = context.held(self) ? state.paused_at : context.now();
  const pacing::Tick tick{.limit = limit,
                          .reaction = reaction,
                          .given = state.given,
                          .seconds = begins ? 0.0 : to_seconds(until - state.last)};
  const bool meets_all =
      context.parameter(self, counts.success_count).integer >= count_actions(context, self);
  const bool is_delta = synchronization(context.node(self)) == Synchronization::Relative;
  const bool asks =
      limit <= std::numeric_limits<double>::max() && (meets_all || (!is_delta && limit < 1.0));
  const auto numbers = context.child_states<double>(self);
  const auto own = paced_children(context, self);
  const std::uint32_t last_tick = context.run_state().last_tick[self];
  pacing::set_factors(context, tick, context.pace(), asks, [&](auto visit) {
    std::size_t place = 0;
    for (NodeIndex child = self + 1; child != context.end_of(self); child = context.end_of(child)) {
      const double reached = numbers[place];
      PacedChild& it = own[place++];
      if (context.is_guard(child)) {
        it = {};
        continue;
      }
      visit(pacing::Child{.node = child,
                          .reached = reached,
                          .is_in = !begins && context.status(child) == Status::Running,
                          .was_ticked = context.run_state().last_tick[child] == last_tick,
                          .is_held = reached >= held_from},
            it);
    }
  });
  state = {.last = context.now(), .paused_at = state.paused_at, .given = context.pace()};
  return {own.data()};
}

// The rest of a tick, once its limit is known. `pace`: the place of that parameter.
template <bool kPaces>
Status tick_up_to(NodeContext& context, NodeIndex self, const parallel::Counts& counts,
                  double limit, double held_from, [[maybe_unused]] unsigned pace) {
  if constexpr (kPaces) {
    const double reaction = context.parameter(self, pace + 1).number;
    const Paced paced = set_paces(context, self, counts, limit, held_from, reaction);
    return tick_children(context, self, counts, held_from, paced);
  } else {
    return tick_children(context, self, counts, held_from, Plain{});
  }
}

inline void pause_paced(NodeContext& context, NodeIndex self) {
  context.state<PacedState>(self).pacing.paused_at = context.now();
}

inline const PacedChild* paced_child(const RunView& run, NodeIndex self, std::uint32_t child) {
  const auto numbers = run.child_states<double>(self);
  return reinterpret_cast<const PacedChild*>(numbers.data() + numbers.size()) + child;
}

// The kind of a parallel that paces.
inline NodeKind paced_kind(const NodeKind& plain, Status (*tick)(NodeContext&, NodeIndex)) {
  NodeKind kind = plain;
  kind.tick = tick;
  kind.state_size = sizeof(PacedState);
  kind.state_per_child = sizeof(double) + sizeof(PacedChild);
  kind.pause = pause_paced;
  kind.paced_child = paced_child;
  kind.paced = nullptr;
  return kind;
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
