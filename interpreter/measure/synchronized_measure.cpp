#include "measure/synchronized_measure.h"

#include <algorithm>

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
  const NodeIndex end = tree.nodes[node].end;
  for (NodeIndex child = node + 1; child < end; child = tree.nodes[child].end) {
    children.push_back(child);
  }
  return children;
}

void SynchronizedMeasure::reset() {
  distance_.reset();
  std::ranges::fill(held_, Held{});
  last_ = Nanoseconds(0);
}

void SynchronizedMeasure::after_tick(const SynchronizedTick& tick) {
  pass_time(tick.time);
  distance_.after_tick(tick.ticked, tick.status, tick.progress);
  for (std::size_t child = 0; child < held_.size(); ++child) {
    Held& child_held = held_[child];
    const bool held = tick.ticked && tick.held[child];
    child_held.ticks += held;
    child_held.now = held && tick.status == Status::Running;
    if (!tick.ticked && tick.status == Status::Running) continue;
    child_held.waits += held && !child_held.is_waiting;
    child_held.is_waiting = child_held.now;
  }
}

void SynchronizedMeasure::pass_time(Nanoseconds time) {
  for (Held& child : held_) {
    if (child.now) child.time += time - last_;
  }
  last_ = time;
}

SynchronizedProbe::SynchronizedProbe(const Tree& tree, NodeIndex node)
    : node_(node), children_(children_of(tree, node)), held_(children_.size()) {}

SynchronizedTick SynchronizedProbe::read(Ticker& ticker, Nanoseconds time) {
  SynchronizedTick tick;
  tick.time = time;
  tick.ticked = ticker.ticked(node_);
  tick.status = ticker.status(node_);
  for (std::size_t child = 0; child < children_.size(); ++child) {
    const NodeIndex node = children_[child];
    held_.set(child, ticker.status(node), ticker.ticked(node), ticker.held(node));
  }
  if (!tick.ticked) return tick;
  if (succeeded(ticker, node_)) tick.status = Status::Success;
  tick.limit = limit(ticker, node_);
  tick.progress = child_progress(ticker, node_);
  tick.held = {held_.data(), children_.size()};
  return tick;
}

}  // namespace lockstep
