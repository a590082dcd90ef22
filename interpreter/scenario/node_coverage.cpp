#include "scenario/node_coverage.h"

#include <cmath>
#include <utility>

#include "engine/synchronized.h"

namespace lockstep::host {
namespace {

Aspect aspect_of(Status result) {
  if (result == Status::Success) return Aspect::Success;
  return result == Status::Failure ? Aspect::Failure : Aspect::Skipped;
}

}  // namespace

NodeCoverage::NodeCoverage(const Tree& tree)
    : tree_(tree), seen_(tree.nodes.size()), ticks_(tree.nodes.size()) {
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const auto constants = host::barriers(tree, node);
    if (!constants) continue;
    for (const double it : *constants) barriers_[node].emplace(it, false);
  }
}

void NodeCoverage::add(std::span<const Activity> before, const Moment& moment) {
  before_.clear();
  for (const Activity it : before) before_.push_back(NodeState::of(it, false));
  const MomentsView moments = moment.within;
  moments.each(moment_, [this](std::span<const NodeState> now, const TickMoment&, bool) {
    for (NodeIndex node = 0; node < tree_.nodes[0].end; ++node) add(node, now[node]);
  });
  for (const NodeTotals& it : moments.rest) add(it);
  for (NodeIndex node = 0; node < tree_.nodes[0].end; ++node) {
    if (moment.ticked(node)) ++ticks_[node];
    if (moments.empty()) add(node, moment.state(node));
  }
  if (!barriers_.empty()) add_barriers(moment);
}

void NodeCoverage::add(NodeIndex node, NodeState now) {
  AspectSet& seen = seen_[node];
  const NodeState before = std::exchange(before_[node], now);
  if (now.ticked()) {
    seen.add(Aspect::Ticked);
    if (has_ended(now.status())) seen.add(aspect_of(now.status()));
  }
  const bool ran = before.status() == Status::Running || now.ticked();
  if (ran && now.status() == Status::Idle) seen.add(Aspect::Halted);
  if (now.held()) seen.add(Aspect::Held);
}

void NodeCoverage::add(const NodeTotals& totals) {
  if (totals.node >= tree_.nodes[0].end) return;
  constexpr std::pair<NodeTotals::Kind, Aspect> kCounted[] = {
      {NodeTotals::kSuccess, Aspect::Success},
      {NodeTotals::kFailure, Aspect::Failure},
      {NodeTotals::kSkipped, Aspect::Skipped},
      {NodeTotals::kHalted, Aspect::Halted},
      {NodeTotals::kHeld, Aspect::Held}};
  for (const auto& [kind, aspect] : kCounted) {
    if (totals.counts[kind] > 0) seen_[totals.node].add(aspect);
  }
}

void NodeCoverage::add_barriers(const Moment& moment) {
  for (auto& [node, waited] : barriers_) {
    if (!moment.ticked(node)) continue;
    bool is_held = false;
    for_each_child(tree_, node, [&](NodeIndex child) { is_held |= moment.held(child); });
    const auto current = waited.find(moment.limit(node));
    if (is_held && current != waited.end()) current->second = true;
  }
}

void NodeCoverage::add(const NodeCoverage& other) {
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    seen_[i].bits |= other.seen_[i].bits;
    ticks_[i] += other.ticks_[i];
  }
  for (auto& [node, waited] : barriers_) {
    for (auto& [barrier, is_reached] : waited) {
      is_reached |= other.barriers_.at(node).at(barrier);
    }
  }
}

void RunCoverage::before_tick(const Moment& moment, std::uint64_t, Nanoseconds) {
  before_.assign(moment.activity.begin(), moment.activity.end());
}

void RunCoverage::after_tick(const Moment& moment, const TickReport&) {
  coverage_.add(before_, moment);
}

}  // namespace lockstep::host
