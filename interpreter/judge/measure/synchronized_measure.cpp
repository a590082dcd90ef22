#include "judge/measure/synchronized_measure.h"

#include <algorithm>
#include <limits>

#include "engine/resources.h"
#include "engine/ticker.h"

namespace lockstep::host {

std::vector<NodeIndex> synchronized_nodes(const Tree& tree) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (synchronization(tree.nodes[node]) != Synchronization::None) nodes.push_back(node);
  }
  return nodes;
}

std::vector<NodeIndex> children_of(const Tree& tree, NodeIndex node) {
  std::vector<NodeIndex> children;
  for_each_child(tree, node, [&](NodeIndex child) { children.push_back(child); });
  return children;
}

Guards::Guards(std::vector<bool> guards) {
  for (std::size_t child = 0; child < guards.size(); ++child) {
    if (guards[child]) places_.push_back(child);
  }
  if (!places_.empty()) others_.resize(guards.size());
}

std::span<const double> Guards::leave_out(std::span<const double> progress) {
  if (places_.empty()) return progress;
  std::ranges::copy(progress, others_.begin());
  for (const std::size_t guard : places_) others_[guard] = kLeftOut;
  return others_;
}

SynchronizedMeasure::SynchronizedMeasure(std::size_t children, const Guards& guards,
                                         Synchronization synchronization, bool is_group)
    : distance_({.children = children}),
      spread_({}),
      step_length_({.children = children}),
      guards_(guards.count()),
      synchronization_(synchronization),
      falls_(children, !is_group) {
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
  const auto left_out = std::ranges::count_if(tick.progress, is_left_out);
  left_out_ |= static_cast<std::size_t>(left_out) > guards_;
  const double least = least_progress(tick.progress);
  const double most = std::min(1.0, farthest(synchronization_, tick.limit, least));
  widest_ = std::max(widest_, most - least);
}

std::optional<double> SynchronizedMeasure::bound() const {
  const bool is_bounded = !falls_.while_ticked() && !falls_.while_held() &&
                          !falls_.rise_while_held() && !falls_.rise_before();
  if (!is_bounded || left_out_) return std::nullopt;
  return std::min(1.0, widest_ + step_length());
}

void SynchronizedMeasure::run_ended(Nanoseconds time) {
  for (HeldChild& child : held_) child.run_ended(time);
}

namespace {

// A pool compares nothing.
Guards guards_of(const Tree& tree, NodeIndex node, std::span<const NodeIndex> children) {
  std::vector<bool> guards;
  if (is_pool(tree, node)) return Guards();
  for (const NodeIndex child : children) guards.push_back(tree.nodes[child].is_guard != 0);
  return Guards(std::move(guards));
}

}  // namespace

SynchronizedProbe::SynchronizedProbe(const Tree& tree, NodeIndex node, bool with_flags)
    : node_(node),
      children_(children_of(tree, node)),
      is_group_(tree.is_group(node)),
      with_flags_(with_flags),
      is_pool_(is_pool(tree, node)),
      held_(children_.size()),
      guards_(guards_of(tree, node, children_)) {
  if (!compares_progress(synchronization(tree.nodes[node]))) {
    progress_.resize(children_.size());
  }
}

// A node that does not run will start again: none of its children has progress then. Else as in
// the snapshot of a synchronized node: a child that was skipped is left out, and one that has
// failed for good counts as 1.
void SynchronizedProbe::read_progress(Ticker& ticker) {
  const bool runs = ticker.status(node_) == Status::Running;
  for (std::size_t child = 0; child < progress_.size(); ++child) {
    progress_[child] = runs ? snapshot_of(ticker, children_[child]) : 0;
  }
}

void SynchronizedProbe::read_held(Ticker& ticker, bool asked) {
  for (std::size_t child = 0; child < children_.size(); ++child) {
    const NodeIndex node = children_[child];
    if (is_pool_) {
      held_.set(child, ticker.ticked(node - 1) && waits(limit(ticker, node - 1)));
      continue;
    }
    const bool asks = is_group_ ? ticker.ticked(ticker.tree().labels[node].parent) : asked;
    held_.set(child, ticker.status(node), ticker.ticked(node) || !asks, ticker.held(node) && asks);
  }
}

void SynchronizedProbe::read(Ticker& ticker, Nanoseconds time, SynchronizedTick& tick) {
  const bool asked = asked_children(ticker, node_);
  if (with_flags_) read_held(ticker, asked);
  if (!asked) {
    tick = {.time = time, .status = ticker.status(node_)};
    return;
  }
  tick.time = time;
  tick.ticked = true;
  tick.status = ticker.status(node_);
  if (progress_.empty()) {
    tick.limit = limit(ticker, node_);
    tick.used = child_progress(ticker, node_);
  } else {
    tick.used = progress_;
  }
  tick.progress = guards_.leave_out(tick.used);
  if (with_flags_) read_succeeded(ticker, tick);
}

void SynchronizedProbe::read_succeeded(Ticker& ticker, SynchronizedTick& tick) {
  for (std::size_t child = 0; child < children_.size(); ++child) {
    const NodeIndex node = children_[child];
    held_.set_succeeded(child,
                        ticker.status(node) == Status::Success || ticker.ended_after_success(node));
  }
  tick.held = held_.held();
  tick.succeeded = held_.succeeded();
}

}  // namespace lockstep::host
