// A run at this moment, to read: what the tree says of a node, and what RunState does.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/core/deadlines.h"
#include "engine/node.h"
#include "engine/run_state.h"

namespace lockstep::host {

struct Blackboard;
struct Tree;

class RunView {
 public:
  RunView(const RunView&) = delete;
  RunView& operator=(const RunView&) = delete;

  const Tree& tree() const { return tree_; }
  const Blackboard& blackboard() const { return board_; }
  const RunState& run_state() const { return state_; }

  const Node& node(NodeIndex node) const { return nodes_[node]; }
  NodeIndex end_of(NodeIndex node) const { return nodes_[node].end; }
  bool is_guard(NodeIndex node) const { return nodes_[node].is_guard != 0; }
  bool is_latched(NodeIndex node) const { return nodes_[node].is_latched != 0; }

  Activity activity(NodeIndex node) const { return state_.activity[node]; }
  Status status(NodeIndex node) const { return status_of(state_.activity[node]); }
  // True until the node has been Running: the first tick of an activation.
  bool first_tick(NodeIndex node) const { return status(node) != Status::Running; }
  bool held(NodeIndex node) const { return state_.activity[node] == Activity::Paused; }
  bool ticked(NodeIndex node) const {  // in the last tick
    return state_.tick_number != 0 && state_.last_tick[node] == state_.tick_number;
  }
  // True for a node that succeeded in the last tick and is idle again, since an ancestor was ended
  // later in that tick.
  bool ended_after_success(NodeIndex node) const {
    return std::ranges::find(state_.ended, node) != state_.ended.end();
  }
  // In this tick so far; while moments are kept, `ticked` is about this moment.
  bool ticked_so_far(NodeIndex node) const {
    return ticked(node) || state_.last_tick[node] == ~state_.tick_number;
  }
  NodeState node_state(NodeIndex node) const {
    return NodeState::of(state_.activity[node], ticked(node));
  }
  // The state of a node in RunState.
  template <class State>
  const State& state(NodeIndex node) const {
    return *reinterpret_cast<const State*>(state_bytes() + nodes_[node].state);
  }
  // The values that a kind with state_per_child keeps behind that, one for each child.
  template <class T>
  std::span<const T> child_states(NodeIndex node) const {
    const Node& it = nodes_[node];
    const std::byte* const first = state_bytes() + it.state + it.kind->state_size;
    return {reinterpret_cast<const T*>(first), it.children};
  }

  // The number of the last tick; the first is 1.
  std::uint32_t tick_number() const { return state_.tick_number; }
  Nanoseconds now() const { return state_.now; }  // of this tick, since the run began
  // The time from `since`, that of a tick, to this tick or to `until`.
  Nanoseconds passed(Nanoseconds since) const { return passed(since, state_.now); }
  Nanoseconds passed(Nanoseconds since, Nanoseconds until) const {
    return deadlines_.between(since, until);
  }
  const Deadlines& deadlines() const { return deadlines_; }
  // Before the first tick.
  void set_deadlines(const Deadlines& deadlines) { deadlines_ = deadlines; }
  bool faulted() const { return state_.faulted; }

 protected:
  // Both must outlive this.
  RunView(const Tree& tree, Blackboard& board);
  ~RunView() = default;
  const std::byte* state_bytes() const {
    return reinterpret_cast<const std::byte*>(state_.bytes.data());
  }

  const Tree& tree_;
  const Node* nodes_;  // of the tree, or with the kinds of nodes that are watched
  Blackboard& board_;
  RunState state_;
  Deadlines deadlines_;
};

}  // namespace lockstep::host
