// A node that fails because its owner says so: between two ticks it is marked, and its next tick is
// a Failure instead of what it would have been.
#include <algorithm>

#include "engine/synchronized.h"

namespace lockstep {

void Ticker::fail_next(NodeIndex node) {
  if (std::ranges::find(failing_, node) == failing_.end()) failing_.push_back(node);
  interrupted_ = true;
}

bool Ticker::take_failed(NodeIndex node) {
  const bool was_reached = std::erase(failing_, node) == 0;
  interrupted_ = faulted_ || !failing_.empty();
  return was_reached;
}

// Of a tick in which something is wrong. Nothing: the node is ticked as always.
[[gnu::cold, gnu::noinline]] std::optional<Status> Ticker::tick_interrupted(NodeIndex node) {
  if (faulted_) return Status::Running;
  const auto it = std::ranges::find(failing_, node);
  if (it == failing_.end() || status(node) != Status::Running) return std::nullopt;
  failing_.erase(it);
  return fail(node);
}

// A node of a plugin halts its children in its own way, so it fails as after a fault. The children
// of a built-in node are halted as when it completes by itself.
Status Ticker::fail(NodeIndex node) {
  const bool is_hooked = !tree_.hooks.empty() && tree_.hooks[node] != HookedNode::kNoScript;
  const HookedNode* const hooked = is_hooked ? &tree_.hooked[tree_.hooks[node]] : nullptr;
  Status status = Status::Failure;
  if (tree_.labels[node].type->leaf != nullptr) {
    leaf(node).failed = true;
    status = (hooked != nullptr ? hooked->kind : nodes_[node].kind)->tick(*this, node);
  } else {
    halt_running_children(node);
    if (compares_progress(synchronization(nodes_[node]))) {
      state<SynchronizedState>(node).succeeded = false;
    }
  }
  if (hooked != nullptr && hooked->ends) status = finish(node, *hooked, status);
  if (faulted_) status = Status::Running;
  state_.activity[node] = static_cast<Activity>(status);
  state_.last_tick[node] = tick_number_;
  return status;
}

}  // namespace lockstep
