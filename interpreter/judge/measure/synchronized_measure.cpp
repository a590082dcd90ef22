#include "judge/measure/synchronized_measure.h"

#include <algorithm>

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
