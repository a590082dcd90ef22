#include "verify/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/synchronized.h"

namespace lockstep::host {

SearchCoverage::SearchCoverage(const Tree& tree) : seen_(tree.nodes.size()) {
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (tree.labels[node].type->limits_time) timeouts_.push_back(node);
    if (compares_progress(synchronization(tree.nodes[node]))) synchronized_.push_back({node});
  }
}

void SearchCoverage::after_tick(Ticker& ticker) {
  // Of all nodes in each tick, so it has no branches.
  static constexpr auto kBits = [] {
    std::array<std::uint8_t, kWithheld> bits{};
    for (unsigned status = 0; status < bits.size(); ++status) {
      bits[status] = static_cast<std::uint8_t>(kTicked | 1u << status);
    }
    return bits;
  }();
  const RunState& state = ticker.run_state();
  const Activity* const activity = state.activity.data();
  const std::uint32_t* const last_tick = state.last_tick.data();
  std::uint8_t* const seen = seen_.data();
  const Fault* const fault = ticker.fault();
  const std::uint8_t before_fault = fault == nullptr ? std::uint8_t{0} : seen[fault->node];
  for (std::size_t node = 0; node < seen_.size(); ++node) {
    const bool is_ticked = last_tick[node] == state.tick_number;
    const std::uint8_t bits = kBits[static_cast<std::uint8_t>(activity[node]) % kWithheld];
    seen[node] = static_cast<std::uint8_t>(seen[node] | (is_ticked ? bits : 0u));
  }
  // Its status is that of a node in the middle of a tick.
  if (fault != nullptr) seen[fault->node] = before_fault | kTicked;
  const auto look_at_timeouts = [this](auto state_of) {
    for (const NodeIndex node : timeouts_) {
      const NodeState it = state_of(node);
      const bool fired = it.ticked() && it.status() == Status::Failure &&
                         state_of(node + 1).status() == Status::Idle;
      if (fired) seen_[node] |= kFired;
    }
  };
  look_at_timeouts([&](NodeIndex node) { return ticker.node_state(node); });
  ticker.moments().each_part(moment_, [&](std::span<const NodeState> states, bool, bool) {
    for (NodeIndex node = 0; node < states.size(); ++node) {
      if (states[node].ticked()) seen_[node] |= kBits[index_of(states[node].status())];
    }
    look_at_timeouts([&](NodeIndex node) { return states[node]; });
  });
  for (Synchronized& it : synchronized_) look_at(ticker, it);
}

void SearchCoverage::look_at(Ticker& ticker, Synchronized& it) const {
  if (!asked_children(ticker, it.node)) return;
  const double now = limit(ticker, it.node);
  if (now != it.last_limit && it.limits.size() < 1000) it.limits.insert(now);
  it.last_limit = now;
  double least = 1, most = 0;
  const double* progress = child_progress(ticker, it.node).data();
  for_each_child(ticker.tree(), it.node, [&](NodeIndex child) {
    const double one = *progress++;
    if (is_left_out(one) || ticker.is_guard(child)) return;
    least = std::min(least, one);
    most = std::max(most, one);
  });
  it.largest_spread = std::max(it.largest_spread, most - least);
}

void SearchCoverage::add(const Synchronized& from, Synchronized& to) {
  to.limits.insert(from.limits.begin(), from.limits.end());
  to.largest_spread = std::max(to.largest_spread, from.largest_spread);
}

void SearchCoverage::add(const SearchCoverage& other) {
  for (std::size_t i = 0; i < seen_.size(); ++i) seen_[i] |= other.seen_[i];
  for (std::size_t i = 0; i < synchronized_.size(); ++i) {
    add(other.synchronized_[i], synchronized_[i]);
  }
}

void SearchCoverage::spread(const Symmetry& symmetry) {
  for (NodeIndex node = 0; node < seen_.size(); ++node) {
    seen_[symmetry.first_like(node)] |= seen_[node];
  }
  for (NodeIndex node = 0; node < seen_.size(); ++node) {
    seen_[node] = seen_[symmetry.first_like(node)];
  }
  const auto first_of = [&](const Synchronized& it) -> Synchronized& {
    return *std::ranges::find(synchronized_, symmetry.first_like(it.node), &Synchronized::node);
  };
  for (const Synchronized& it : synchronized_) add(it, first_of(it));
  for (Synchronized& it : synchronized_) add(first_of(it), it);
}

}  // namespace lockstep::host
