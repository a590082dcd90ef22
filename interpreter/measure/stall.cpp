#include "measure/stall.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/synchronized.h"

namespace lockstep {
namespace {

constexpr double kNoChange = 1e-9;

}  // namespace

std::span<const std::size_t> StallDetector::after_tick(const SynchronizedTick& tick) {
  const bool somebody_waits = tick.ticked && tick.status == Status::Running &&
                              std::ranges::find(tick.held, true) != tick.held.end();
  std::size_t found = 0;
  for (std::size_t i = 0; i < children_.size(); ++i) {
    const bool suspect = somebody_waits && !tick.held[i] && tick.progress[i] < 1.0;
    const double progress = suspect ? tick.progress[i] : 0.0;
    if (stalls(children_[i], tick.time, progress, suspect)) found_[found++] = i;
  }
  return std::span(found_).first(found);
}

bool StallDetector::stalls(Child& child, Nanoseconds time, double progress, bool suspect) const {
  if (!suspect || !child.watched || std::abs(progress - child.progress) > kNoChange) {
    child = {.watched = suspect, .progress = progress, .since = time};
    return false;
  }
  if (child.reported || time - child.since <= limit_) return false;
  child.reported = true;
  return true;
}

StallWatch::StallWatch(const Tree& tree, Nanoseconds limit, Report report)
    : report_(std::move(report)) {
  for (const NodeIndex node : synchronized_nodes(tree)) {
    nodes_.push_back(
        {SynchronizedProbe(tree, node), StallDetector(tree.nodes[node].children, limit)});
  }
}

void StallWatch::after_tick(Ticker& ticker, Nanoseconds time) {
  for (Watched& watched : nodes_) {
    const SynchronizedTick tick = watched.probe.read(ticker, time);
    for (const std::size_t child : watched.detector.after_tick(tick)) {
      report_({.node = watched.probe.node(),
               .child = watched.probe.children()[child],
               .since = watched.detector.since(child),
               .time = time,
               .progress = tick.progress[child]});
    }
  }
}

}  // namespace lockstep
