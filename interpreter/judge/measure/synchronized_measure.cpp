#include "judge/measure/synchronized_measure.h"

#include <algorithm>
#include <utility>

namespace lockstep::host {

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
  if (is_pool()) {  // it compares no progress: only the waits of its members count
    for (HeldChild& child : held_) child.after_tick(view);
    return;
  }
  tick.ticked ? see_children(view) : pass_time_of_held(view);
  step_length_.end_tick(tick);
  falls_.end_tick(tick);
}

// All measures in one pass.
void SynchronizedMeasure::see_children(const TickView& view) {
  const SynchronizedTick& tick = view.parallels[0];
  Extent extent;
  std::size_t left_out = 0;
  for (std::size_t child = 0; child < held_.size(); ++child) {
    const double progress = tick.progress[child];
    if (is_left_out(progress)) ++left_out;
    extent.see(progress);
    // That it was held ends now, if it did.
    if (tick.held[child] || falls_.was_held(child)) held_[child].after_tick(view);
    step_length_.see(tick, child);
    falls_.see(tick, child);
  }
  spread_.take(extent);
  if (std::exchange(joins_, false))
    spread_at_join_ = std::max(spread_at_join_, extent.most - extent.least);
  left_out_ |= left_out > guards_;
  const double most = std::min(1.0, farthest(synchronization_, tick.limit, extent.least));
  widest_ = std::max(widest_, most - extent.least);
}

void SynchronizedMeasure::pass_time_of_held(const TickView& view) {
  for (std::size_t child = 0; child < held_.size(); ++child) {
    if (falls_.was_held(child)) held_[child].after_tick(view);
  }
}

std::optional<double> SynchronizedMeasure::bound() const {
  const bool is_bounded = !falls_.while_ticked() && !falls_.while_held() &&
                          !falls_.rise_while_held() && !falls_.rise_before();
  if (!is_bounded || left_out_) return std::nullopt;
  const double bound = std::min(1.0, widest_ + step_length());
  return spread_at_join_ <= bound ? std::optional(bound) : std::nullopt;
}

void SynchronizedMeasure::run_ended(Nanoseconds time) {
  for (HeldChild& child : held_) child.run_ended(time);
}

std::vector<MeasuredNode> measured_nodes(const Shape& shape) {
  std::vector<MeasuredNode> nodes;
  for (const NodeIndex index : synchronized_nodes(shape)) {
    const ShapeNode& node = shape.nodes[index];
    SynchronizedTicks ticks(shape, index);
    SynchronizedMeasure measure(node.held().size(), ticks.guards(), node.synchronization,
                                node.is_group());
    nodes.push_back({std::move(ticks), std::move(measure)});
  }
  return nodes;
}

}  // namespace lockstep::host
