#include "engine/node_context.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace lockstep {
namespace {

// Of the next eight nodes: no byte is 0 (S. E. Anderson, "Bit Twiddling Hacks").
bool has_no_idle(const Activity* first) {
  std::uint64_t block = 0;
  std::memcpy(&block, first, sizeof block);
  return ((block - 0x0101010101010101u) & ~block & 0x8080808080808080u) == 0;
}

}  // namespace

NodeContext::NodeContext(const Tree& tree, std::span<LeafSlot> leaves, Blackboard& board,
                         FaultPolicy policy)
    : tree_(tree),
      nodes_(tree.nodes.data()),
      leaves_(leaves),
      board_(board),
      parameters_(tree, board),
      state_(tree),
      names_(tree.boards, board.entries),
      scripts_(tree, board, names_),
      policy_(policy),
      held_leaves_(leaves.size()) {
  if (tree.has_halt_hooks) halting_.reserve(tree.hooked.size());
}

bool NodeContext::refresh(NodeIndex node) {
  return !nodes_[node].kind->reads_entries || parameters_.read(bound_of(node)).empty();
}

bool NodeContext::reread(NodeIndex node) {
  if (!nodes_[node].kind->reads_entries) return true;
  std::string wrong = parameters_.read(bound_of(node));
  if (wrong.empty()) return true;
  set_fault(node, std::move(wrong));
  return false;
}

Status NodeContext::give_up(NodeIndex node) {
  if (state_.faulted) return Status::Running;
  halt_running_children(node);
  return Status::Failure;
}

Status NodeContext::tick_bound(NodeIndex node) {
  if (!reread(node)) return give_up(node);
  return tree_.bound[bound_of(node)].kind->tick(*this, node);
}

// A subtree that was not reached costs nothing, however large it is: below an idle node all are
// idle. Where all are active, eight nodes at a time. What a skipped node keeps is over when its
// parent has completed, not when that was skipped too.
void NodeContext::forget_descendants(NodeIndex node) {
  if (tree_.keeps_over_skips && state_.activity[node] != Activity::Skipped) {
    forget_skipped(node + 1, nodes_[node].end);
  }
  constexpr NodeIndex kBlock = sizeof(std::uint64_t);
  Activity* const all = state_.activity.data();
  const NodeIndex end = nodes_[node].end;
  for (NodeIndex at = node + 1; at < end;) {
    if (all[at] == Activity::Idle) {
      at = nodes_[at].end;
    } else if (end - at >= kBlock && has_no_idle(all + at)) {
      std::memset(all + at, 0, kBlock);
      at += kBlock;
    } else {
      all[at++] = Activity::Idle;
    }
  }
}

void NodeContext::forget_skipped(NodeIndex first, NodeIndex last) {
  for (NodeIndex node = first; node < last; ++node) {
    const auto forget = nodes_[node].kind->forget;
    if (state_.activity[node] == Activity::Skipped && forget != nullptr) forget(*this, node);
  }
}

// Returns the next node that may not be idle.
NodeIndex NodeContext::end_activation(NodeIndex node) {
  Activity& activity = state_.activity[node];
  if (activity == Activity::Idle) return nodes_[node].end;
  const bool running = status_of(activity) == Status::Running;
  const NodeKind& kind = *nodes_[node].kind;
  if (activity == Activity::Skipped && kind.forget != nullptr) kind.forget(*this, node);
  activity = Activity::Idle;
  if (running && tree_.has_halt_hooks) note_halt(node);
  if (running && kind.halt != nullptr) kind.halt(*this, node);
  return node + 1;
}

// The scripts of halted nodes run from the left, those of children before those of their parent.
void NodeContext::halt_range(NodeIndex first, NodeIndex last) {
  const std::size_t hooks = halting_.size();
  // After a fault all halts are halt_all's, so that they come in one order.
  for (NodeIndex node = first; node < last && (!state_.faulted || state_.in_last_halt);) {
    if (halting_.size() > hooks) run_halt_hooks(hooks, node);
    node = end_activation(node);
  }
  if (halting_.size() > hooks) run_halt_hooks(hooks, last);
  if (state_.in_last_halt) return;
  // A fault of a leaf's halt: its siblings may still run, so the nodes around them do too.
  if (state_.faulted) [[unlikely]]
    keep_ancestors_running(state_.fault.node);
}

void NodeContext::halt_running_children(NodeIndex node) {
  for (NodeIndex child = node + 1; child != end_of(node); child = end_of(child)) {
    if (status(child) == Status::Running) halt(child);
  }
}

void NodeContext::pause(NodeIndex node) {
  for (NodeIndex at = node; at < nodes_[node].end && !state_.faulted;) {
    const Node& it = nodes_[at];
    if (state_.activity[at] != Activity::Running) {  // so nothing below it needs a call either
      at = it.end;
      continue;
    }
    state_.activity[at] = Activity::Paused;
    if (it.kind->pause != nullptr) it.kind->pause(*this, at);
    ++at;
  }
}

void NodeContext::set_fault(NodeIndex node, std::string message) {
  Fault fault{node, std::move(message), state_.in_last_halt};
  if (state_.in_last_halt ? state_.faulted : policy_ == FaultPolicy::Fail) {
    if (tree_.labels[node].type->leaf != nullptr) note_failed_leaf(node);
    state_.tolerated.push_back(std::move(fault));
    return;
  }
  if (state_.faulted) return;  // the first is the cause
  state_.faulted = state_.interrupted = true;
  state_.fault = std::move(fault);
}

void NodeContext::keep_ancestors_running(NodeIndex node) {
  while (node != tree_.labels[node].parent) {
    node = tree_.labels[node].parent;
    if (status(node) != Status::Running) state_.activity[node] = Activity::Running;
  }
}

void NodeContext::note_out_of_range(NodeIndex node, double reported) {
  if (std::exchange(leaf(node).out_of_range, true)) return;
  state_.out_of_range.push_back({node, reported});
}

}  // namespace lockstep
