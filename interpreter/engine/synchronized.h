// The state of a synchronized node, a parallel or a barrier beside the tree. Who waits for whom
// follows from it: judge/measure/wait_chain.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/core/progress.h"
#include "base/core/synchronization.h"
#include "engine/node_context.h"
#include "engine/tree.h"

namespace lockstep::host {

// The least number that is more than this progress.
inline double least_above(double progress) {
  return std::nextafter(progress + kProgressEpsilon, std::numeric_limits<double>::infinity());
}

// The state of a synchronized node, with the progress of each child behind it (child_states).
struct SynchronizedState {
  double limit;         // see limit()
  std::uint32_t place;  // of the last barrier in its list: where the search for the next begins
};

inline Synchronization synchronization(const Node& node) {
  return static_cast<Synchronization>(node.synchronizes);
}

// The limit in the node's last tick. ParallelAbsolute: the current barrier, infinity if none is
// left. ParallelRelative: delta. Also of a node that uses resources: engine/resources.h.
inline double limit(const RunView& run, NodeIndex node) {
  return run.state<SynchronizedState>(node).limit;
}

// Visits the nodes that a synchronized node, or any other, holds or ticks: the children of a
// parallel, and of a group what each member holds.
template <class Visit>
void for_each_child(const Tree& tree, NodeIndex node, Visit visit) {
  if (tree.is_group(node)) {
    for (const Member& member : tree.members_of(node)) visit(member.node + 1);
    return;
  }
  for (NodeIndex child = node + 1; child != tree.nodes[node].end; child = tree.nodes[child].end) {
    visit(child);
  }
}

// The nodes of the tree that keep their children in step, in pre-order, and the pools.
std::vector<NodeIndex> synchronized_nodes(const Tree& tree);
// The nodes that the node may hold: the children of a parallel; of a group, what its members hold.
std::vector<NodeIndex> children_of(const Tree& tree, NodeIndex node);

// The progress of each child at the start of its parallel's last tick, as the node used it: 1 for a
// child that has succeeded, not a number for one that was left out. Only for nodes that compare
// progress; valid until the next tick.
inline std::span<const double> child_progress(const RunView& run, NodeIndex node) {
  return run.child_states<double>(node);
}

// Whether a parallel, or a node beside the tree, asked its children in the last tick. A tick in
// which a script of the parallel decided, or in which its `while` halted it, does not count.
inline bool asked_children(const RunView& run, NodeIndex node) {
  if (run.tree().is_group(node) || !run.ticked(node)) return run.ticked(node);
  for (NodeIndex child = node + 1; child != run.end_of(node); child = run.end_of(child)) {
    if (run.ticked(child)) return true;
  }
  return false;
}

// Who withholds the ticks of a held node decides about the outermost held node around it: the child
// of a parallel, or of a member of a group.
struct OutermostHold {
  NodeIndex holder, child;
};
OutermostHold hold_of(const RunView& run, NodeIndex held);

// The progress of a child as its parallel counts it. One that was skipped in the last tick is left
// out. Nobody waits for one that has failed and is not ticked again: it counts as 1.
double snapshot_of(NodeContext& context, NodeIndex child);

// Whether a synchronized parallel has withheld the last tick of a running node and may do so again.
bool is_held_by_parallel(const RunView& run, NodeIndex node);

// The membership of a node that holds its child at a barrier beside the tree; null: it does not.
const Member* barrier_member(const Tree& tree, NodeIndex node);
// Whether a member of a barrier beside the tree is held in this tick.
bool is_held_at_barrier(NodeContext& context, NodeIndex member);
// Whether one has succeeded, and so is never held again.
bool has_passed_barrier(NodeContext& context, NodeIndex member);

// The words of two parameters of barriers, by their places: at_barrier="tick", idle="ignore".
inline constexpr std::string_view kAtBarrierChoices[] = {"wait", "tick"};
inline constexpr std::int64_t kTicksAtBarrier = 1;
inline constexpr std::string_view kIdleChoices[] = {"wait", "ignore"};
inline constexpr std::int64_t kIgnoresIdle = 1;

inline constexpr std::string_view kHoldChoices[] = {"tick", "between"};
inline constexpr std::int64_t kHoldsBetween = 1;
inline constexpr Parameter kHoldParameter{
    .name = "hold",
    .type = ValueType::String,
    .doc =
        "When to look whether a child is far enough to be held: at the start of a tick, or also "
        "between the children of a Sequence in it, before the next one begins.",
    .default_text = "tick",
    .choices = kHoldChoices,
    .constant = true};

// The constant of a parameter that the node has, and what binds parameters to entries; null: all
// are constants.
const Cell& cell_of(const Tree& tree, NodeIndex node, unsigned parameter);
const BoundNode* bound_of(const Tree& tree, NodeIndex node);

// The barriers of a ParallelAbsolute, rising, and the delta of a ParallelRelative. Nothing for
// other nodes, and where an entry gives any parameter.
std::optional<std::span<const double>> barriers(const Tree& tree, NodeIndex node);
// Whether there is one at 0, which is not among those: where children begin together.
bool has_barrier_at_zero(const Tree& tree, NodeIndex node);
std::optional<double> delta(const Tree& tree, NodeIndex node);
// Of a node with barriers that are constant.
bool ticks_at_barrier(const Tree& tree, NodeIndex node);
// Of one where an entry gives a parameter: the slot of its barriers, or none.
std::uint32_t entry_of_barriers(const Tree& tree, NodeIndex node);
// A group that leaves out the members that are idle.
bool ignores_idle(const Tree& tree, NodeIndex node);
// hold="between"
bool holds_between(const Tree& tree, NodeIndex node);

// Within the tick of a node: what it is in has reached the limit of a synchronized node with
// hold="between". What it ran through is a control node of a plugin: then it is not known.
bool is_limit_reached(NodeContext& context, NodeIndex node);

}  // namespace lockstep::host
