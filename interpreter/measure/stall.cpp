#include "measure/stall.h"

#include <algorithm>
#include <utility>

#include "engine/synchronized.h"

namespace lockstep {
namespace {

constexpr double kNoChange = 1e-9;

}  // namespace

std::optional<std::size_t> StallDetector::after_tick(const SynchronizedTick& tick) {
  if (!tick.ticked) {
    runs_ = runs_ && tick.status == Status::Running;  // else it was halted
    return std::nullopt;
  }
  const double least = least_progress(tick.progress);
  const bool is_new = !runs_ || least > best_ + kNoChange || least >= 1 - kNoChange;
  runs_ = tick.status == Status::Running;
  if (is_new) {
    best_ = least;
    somebody_waits_ = reported_ = false;
  }
  if (!runs_ || std::ranges::find(tick.held, true) == tick.held.end()) return std::nullopt;
  if (!std::exchange(somebody_waits_, true)) since_ = tick.time;
  if (reported_ || tick.time - since_ <= limit_) return std::nullopt;
  reported_ = true;
  const auto child = std::ranges::find(tick.progress, least);
  return static_cast<std::size_t>(child - tick.progress.begin());
}

StallWatch::StallWatch(const Tree& tree, Nanoseconds limit, Report report)
    : report_(std::move(report)) {
  for (const NodeIndex node : synchronized_nodes(tree)) {
    if (!compares_progress(synchronization(tree.nodes[node]))) continue;
    nodes_.push_back({SynchronizedProbe(tree, node), StallDetector(limit)});
  }
}

void StallWatch::after_tick(Ticker& ticker, Nanoseconds time) {
  for (Watched& watched : nodes_) {
    const SynchronizedTick tick = watched.probe.read(ticker, time);
    const auto child = watched.detector.after_tick(tick);
    if (!child) continue;
    report_({.node = watched.probe.node(),
             .child = watched.probe.children()[*child],
             .since = watched.detector.since(),
             .time = time,
             .progress = tick.progress[*child],
             .best = watched.detector.best()});
  }
}

}  // namespace lockstep
