// Nodes that fail out of turn. One that its owner fails: between two ticks it is marked, and its
// next tick is a Failure instead of what it would have been. And a leaf that has failed as a
// program while its ticks are withheld: it does not wait for them.
#include <algorithm>

#include "engine/groups.h"
#include "engine/node_scripts.h"
#include "engine/node_watch.h"
#include "engine/ticker.h"

namespace lockstep::host {

void Ticker::fail_next(NodeIndex node) {
  if (std::ranges::find(state_.failing, node) == state_.failing.end())
    state_.failing.push_back(node);
  state_.interrupted = true;
}

bool Ticker::take_failed(NodeIndex node) {
  const bool was_reached = std::erase(state_.failing, node) == 0;
  state_.interrupted = state_.faulted || !state_.failing.empty();
  return was_reached;
}

void Ticker::report_fault(NodeIndex leaf, std::string message) {
  watch_held(leaf);  // keeps its progress until its Failure
  set_fault_around(leaf, status(leaf) == Status::Running, std::move(message));
}

void NodeContext::set_fault_around(NodeIndex node, bool runs, std::string message) {
  set_fault(node, std::move(message));
  if (runs || tree_.labels[node].type->leaf == nullptr) return;
  leaf(node).mark(LeafSlot::kFailed, false);
  leaf(node).set_started(false);  // after a fault it counts as running, with nothing to halt
}

// Called in a tick in which something is wrong. Nothing: the node is ticked as always.
[[gnu::cold, gnu::noinline]] std::optional<Status> NodeContext::tick_interrupted(NodeIndex node) {
  if (state_.faulted) return Status::Running;
  const auto it = std::ranges::find(state_.failing, node);
  if (it == state_.failing.end() || status(node) != Status::Running) return std::nullopt;
  state_.failing.erase(it);
  return fail(node);
}

// A node of a plugin halts its children in its own way, so it fails as after a fault. The children
// of a built-in node are halted as when it completes by itself.
Status NodeContext::fail(NodeIndex node) {
  const HookedNode* const hooked = scripts_.around(node);
  Status status = Status::Failure;
  if (tree_.labels[node].type->leaf != nullptr) {
    leaf(node).mark(LeafSlot::kFailed, true);
    const bool is_watched = watches_ != nullptr && watches_->is_watched(node);
    const NodeKind& kind = is_watched          ? watches_->inner_kind(node)
                           : hooked != nullptr ? *hooked->kind
                                               : *nodes_[node].kind;
    status = kind.tick(*this, node);
  } else {
    halt_running_children(node);
  }
  if (hooked != nullptr && hooked->ends) status = scripts_.finish(node, *hooked, status);
  if (watches_ != nullptr) status = tell_result(node, status);
  if (state_.faulted) status = Status::Running;
  state_.activity[node] = static_cast<Activity>(status);
  state_.last_tick[node] = state_.tick_number;
  return status;
}

void NodeContext::note_failed_leaf(NodeIndex node) {
  if (leaf(node).failed()) return;
  leaf(node).mark(LeafSlot::kFailed, true);
  std::erase_if(state_.failed_leaves, [this](NodeIndex it) { return !leaf(it).failed(); });
  state_.failed_leaves.push_back(node);
}

[[gnu::cold, gnu::noinline]] bool NodeContext::has_failed_leaf(NodeIndex child) {
  return std::ranges::any_of(state_.failed_leaves, [&](NodeIndex it) {
    return it >= child && it < end_of(child) && leaf(it).failed();
  });
}

[[gnu::cold, gnu::noinline]] bool NodeContext::fails_itself(NodeIndex child) {
  for (const NodeIndex it : state_.failed_leaves) {
    if (it < child || it >= end_of(child) || !leaf(it).failed()) continue;
    if (it == child) return true;
    halt_failed(it);
  }
  return false;
}

// It stays marked, so that its next tick is a Failure.
void NodeContext::halt_failed(NodeIndex node) {
  if (!leaf(node).started() || status(node) != Status::Running) return;
  nodes_[node].kind->halt(*this, node);
  leaf(node).set_started(false);
  leaf(node).mark(LeafSlot::kFailed, true);
}

}  // namespace lockstep::host
