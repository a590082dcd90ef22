#include "scenario/node_coverage.h"

#include <cmath>

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

void NodeCoverage::add(std::span<const Activity> before, const Ticker& ticker) {
  for (NodeIndex node = 0; node < tree_.nodes[0].end; ++node) {
    AspectSet& seen = seen_[node];
    const Status status = ticker.status(node);
    const bool is_ticked = ticker.ticked(node);
    if (is_ticked) {
      ++ticks_[node];
      seen.add(Aspect::Ticked);
      if (has_ended(status)) seen.add(aspect_of(status));
    }
    const bool ran = status_of(before[node]) == Status::Running || is_ticked;
    if (ran && status == Status::Idle) seen.add(Aspect::Halted);
    if (ticker.held(node)) seen.add(Aspect::Held);
  }
  if (!barriers_.empty()) add_barriers(ticker);
}

void NodeCoverage::add_barriers(const Ticker& ticker) {
  for (auto& [node, waited] : barriers_) {
    if (!ticker.ticked(node)) continue;
    bool is_held = false;
    for_each_child(tree_, node, [&](NodeIndex child) { is_held |= ticker.held(child); });
    const auto current = waited.find(limit(ticker, node));
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

void RunCoverage::before_tick(Ticker& ticker, std::uint64_t, Nanoseconds) {
  before_ = ticker.run_state().activity;
}

void RunCoverage::after_tick(Ticker& ticker, const TickReport&) {
  coverage_.add(before_, ticker);
}

}  // namespace lockstep::host
