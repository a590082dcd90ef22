// What happened within a tick that the state after it does not show: a child that completed was
// begun again, or reset. Such a tick is a row of moments. Each is to those who watch what a tick is
// elsewhere: the state of each node, and which of them were reached. A new moment begins when
//   - the tree is ticked again in the same period,
//   - a node ticks a child again that has been ticked in this moment,
//   - a node that has begun or completed in this moment, or that this tick withholds its ticks
//   from,
//     is halted, or reset with what is around it.
// In a moment each node is ticked at most once. A node is held in a moment if this tick withholds
// its ticks from it, also before the tick has come so far. Example: Retry of Sequence(Reach,
// Grasped), where Reach completes, Grasped fails and Reach begins again: two moments. In the first
// one Reach is Success and Grasped Failure, in the second one Reach is Running.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "trace/node_state.h"

namespace lockstep::host {

struct MomentChange {
  NodeIndex node = 0;
  NodeState before = {}, after = {};

  friend bool operator==(const MomentChange&, const MomentChange&) = default;
};

struct TickMoment {
  std::uint64_t times = 1;    // in a row, each like this one
  std::uint32_t changes = 0;  // the end of its changes: they lead to the next moment, and those of
                              // the last one to the state after the tick

  friend bool operator==(const TickMoment&, const TickMoment&) = default;
};

// The progress of a leaf at the start of a moment, where it is not what it was at the start of the
// one before; at first it is 0.
struct LeafProgress {
  std::uint64_t moment = 0;
  NodeIndex node = 0;
  double progress = 0;

  friend bool operator==(const LeafProgress&, const LeafProgress&) = default;
};

// How often something happened to a node.
struct NodeTotals {
  enum Kind : std::size_t { kSuccess, kFailure, kSkipped, kHalted, kHeld, kKinds };
  NodeIndex node = 0;
  NodeState after = {};  // after the tick
  std::array<std::uint64_t, kKinds> counts{};

  // Adds what happened from one moment to the next.
  void add(NodeState was, NodeState now, std::uint64_t times = 1) {
    const Status status = now.status();
    if (now.ticked() && has_ended(status)) counts[kind_of(status)] += times;
    if (was.status() == Status::Running && status == Status::Idle) ++counts[kHalted];
    if (now.held() && !was.held()) ++counts[kHeld];
  }
  static constexpr std::size_t kind_of(Status result) {
    return index_of(result) - index_of(Status::Success);
  }
  std::uint64_t of(Status result) const { return counts[kind_of(result)]; }
  bool empty() const { return counts == std::array<std::uint64_t, kKinds>{}; }

  friend bool operator==(const NodeTotals&, const NodeTotals&) = default;
};
static_assert(NodeTotals::kind_of(Status::Failure) == NodeTotals::kFailure &&
              NodeTotals::kind_of(Status::Skipped) == NodeTotals::kSkipped);

// The moments of a tick, for those who watch. Empty: the state after the tick tells all.
struct MomentsView {
  std::span<const NodeState> first = {};
  std::span<const TickMoment> moments = {};
  std::span<const MomentChange> changes = {};
  // What happened after these moments, for which there was no room: without its order.
  std::span<const NodeTotals> rest = {};
  std::span<const LeafProgress> progress = {};  // of a run that keeps it

  bool empty() const { return moments.empty(); }
  std::span<const MomentChange> changes_of(std::size_t moment) const {
    const std::uint32_t from = moment == 0 ? 0 : moments[moment - 1].changes;
    return changes.subspan(from, moments[moment].changes - from);
  }
  // Visits the moments in their order. `column` has room for all nodes, and after it their state
  // after the tick.
  template <class Visit>  // (std::span<const NodeState> after, const TickMoment&, bool is_last)
  void each(std::vector<NodeState>& column, Visit visit) const {
    column.assign(first.begin(), first.end());
    for (std::size_t i = 0; i < moments.size(); ++i) {
      visit(std::span<const NodeState>(column), moments[i],
            i + 1 == moments.size() && rest.empty());
      for (const MomentChange& it : changes_of(i)) column[it.node] = it.after;
    }
  }
  // The state after this moment.
  void after(std::size_t moment, std::vector<NodeState>& column) const {
    column.assign(first.begin(), first.end());
    for (std::size_t i = 0; i < moment; ++i) {
      for (const MomentChange& it : changes_of(i)) column[it.node] = it.after;
    }
  }
  // As `each`, for those who need to know only what was so at any time. Of what has no order, each
  // kind of result comes once, for all nodes that had it, and then the state after the tick.
  template <class Visit>  // (std::span<const NodeState> after, bool is_first, bool is_last)
  void each_part(std::vector<NodeState>& column, Visit visit) const {
    bool is_first = true;
    each(column, [&](std::span<const NodeState> it, const TickMoment&, bool is_last) {
      visit(it, std::exchange(is_first, false), is_last);
    });
    if (rest.empty()) return;
    for (const Status result : {Status::Success, Status::Failure, Status::Skipped}) {
      bool is_any = false;
      for (const NodeTotals& it : rest) {
        if (it.of(result) == 0) continue;
        column[it.node] = NodeState::of(static_cast<Activity>(result), true);
        is_any = true;
      }
      if (is_any) visit(std::span<const NodeState>(column), false, false);
      for (const NodeTotals& it : rest) column[it.node] = it.after;
    }
    visit(std::span<const NodeState>(column), false, true);
  }
};

}  // namespace lockstep::host
