#include "engine/ticker.h"

#include <algorithm>
#include <utility>

namespace lockstep {

Ticker::Ticker(const Tree& tree, std::span<LeafSlot> leaves, FaultPolicy policy)
    : tree_(tree), leaves_(leaves), state_(tree), policy_(policy) {}

Status Ticker::tick_root(Nanoseconds now) {
  set_now(now);
  ++tick_number_;
  return tick(0);
}

void Ticker::forget_descendants(NodeIndex node) {
  const auto begin = state_.activity.begin();
  std::fill(begin + node + 1, begin + tree_.nodes[node].end, Activity::Idle);
}

void Ticker::end_activation(NodeIndex node) {
  const bool running = status(node) == Status::Running;
  state_.activity[node] = Activity::Idle;
  const auto halt = tree_.nodes[node].kind->halt;
  if (running && halt != nullptr) halt(*this, node);
}

void Ticker::halt_range(NodeIndex first, NodeIndex last) {
  // After a fault all halts are halt_all's, so that they come in one order.
  for (NodeIndex node = first; node < last && !faulted_; ++node) end_activation(node);
}

void Ticker::halt_all() {
  for (NodeIndex node = 0; node < tree_.nodes.size(); ++node) end_activation(node);
}

void Ticker::halt_running_children(NodeIndex node) {
  for (NodeIndex child = node + 1; child != end_of(node); child = end_of(child)) {
    if (status(child) == Status::Running) halt(child);
  }
}

void Ticker::pause(NodeIndex node) {
  for (NodeIndex at = node; at < tree_.nodes[node].end && !faulted_; ++at) {
    if (state_.activity[at] != Activity::Running) continue;
    state_.activity[at] = Activity::Paused;
    if (const auto pause = tree_.nodes[at].kind->pause) pause(*this, at);
  }
}

double Ticker::progress(NodeIndex node) {
  switch (status(node)) {
    case Status::Running:
      return tree_.nodes[node].kind->progress(*this, node);
    case Status::Success:
      return 1.0;
    default:
      return 0.0;
  }
}

void Ticker::set_fault(NodeIndex node, std::string message) {
  if (policy_ == FaultPolicy::Fail) {
    leaf(node).failed = true;
    tolerated_.push_back({node, std::move(message)});
    return;
  }
  if (faulted_) return;  // the first is the cause
  faulted_ = true;
  fault_ = Fault{node, std::move(message)};
}

void Ticker::reset() {
  state_.reset();
  now_ = Nanoseconds(0);
  tick_number_ = 0;
  faulted_ = false;
  fault_ = {};
  tolerated_.clear();
}

}  // namespace lockstep
