#include "measure/synchronized_measure.h"

#include <algorithm>

#include "core/pre_order.h"
#include "engine/synchronized.h"

namespace lockstep {

std::vector<NodeIndex> synchronized_nodes(const Tree& tree) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (synchronization(tree.nodes[node]) != Synchronization::None) nodes.push_back(node);
  }
  return nodes;
}

std::vector<NodeIndex> children_of(const Tree& tree, NodeIndex node) {
  std::vector<NodeIndex> children;
  for (const NodeIndex child : children_in(tree.nodes, node)) children.push_back(child);
  return children;
}

SynchronizedMeasure::SynchronizedMeasure(std::size_t children, Synchronization synchronization)
    : distance_({.children = children}),
      spread_({}),
      step_length_({.children = children}),
      synchronization_(synchronization),
      falls_(children) {
  for (std::size_t child = 0; child < children; ++child) {
    held_.emplace_back(MeasureTarget{.child = child});
  }
}

void SynchronizedMeasure::after_tick(const SynchronizedTick& tick) {
  const TickView view{.parallels = {&tick, 1}};
  distance_.after_tick(view);
  spread_.after_tick(view);
  step_length_.after_tick(view);
  falls_.after_tick(tick);
  for (HeldChild& child : held_) child.after_tick(view);
  if (!tick.ticked) return;
  const double least = std::ranges::min(tick.progress);
  const double most = std::min(1.0, farthest(synchronization_, tick.limit, least));
  widest_ = std::max(widest_, most - least);
}

std::optional<double> SynchronizedMeasure::bound() const {
  if (falls_.while_ticked() || falls_.while_held()) return std::nullopt;
  return std::min(1.0, widest_ + step_length());
}

void SynchronizedMeasure::run_ended(Nanoseconds time) {
  for (HeldChild& child : held_) child.run_ended(time);
}

SynchronizedProbe::SynchronizedProbe(const Tree& tree, NodeIndex node, bool with_held)
    : node_(node),
      children_(children_of(tree, node)),
      with_held_(with_held),
      held_(children_.size()) {
  if (synchronization(tree.nodes[node]) == Synchronization::None) {
    progress_.resize(children_.size());
  }
}

// A node that does not run will start again: none of its children has progress then.
void SynchronizedProbe::before_tick(Ticker& ticker) {
  const bool runs = ticker.status(node_) == Status::Running;
  for (std::size_t child = 0; child < progress_.size(); ++child) {
    progress_[child] = runs ? ticker.progress(children_[child]) : 0;
  }
}

SynchronizedTick SynchronizedProbe::read(Ticker& ticker, Nanoseconds time) {
  SynchronizedTick tick;
  tick.time = time;
  tick.ticked = ticker.ticked(node_);
  tick.status = ticker.status(node_);
  for (std::size_t child = 0; with_held_ && child < children_.size(); ++child) {
    const NodeIndex node = children_[child];
    held_.set(child, ticker.status(node), ticker.ticked(node), ticker.held(node));
  }
  if (!tick.ticked) return tick;
  if (with_held_) tick.held = {held_.data(), children_.size()};
  tick.progress = progress_;
  if (!progress_.empty()) return tick;
  if (succeeded(ticker, node_)) tick.status = Status::Success;
  tick.limit = limit(ticker, node_);
  tick.progress = child_progress(ticker, node_);
  return tick;
}

}  // namespace lockstep
