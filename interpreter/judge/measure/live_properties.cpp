#include "judge/measure/live_properties.h"

#include <algorithm>

#include "engine/blackboard.h"
#include "engine/synchronized.h"
#include "engine/ticker.h"
#include "judge/measure/synchronized_measure.h"

namespace lockstep::host {

PropertyNames property_names(const Shape& shape) {
  PropertyNames names{.paths = paths_of(shape), .entries = {}};
  for (const ShapeEntry& it : shape.entries)
    names.entries.push_back({it.key, it.type, it.is_strict});
  return names;
}

LiveProperties::LiveProperties(const Tree& tree, PropertyChecks& checks)
    : checks_(checks), moment_(tree.nodes.size()), writes_(checks.comparisons().size()) {
  for (std::size_t place = 0; place < checks.nodes().size(); ++place) {
    if (checks.needs_progress(place)) asked_.push_back(place);
  }
  if (!asked_.empty()) {
    for (const NodeIndex keeper : synchronized_nodes(tree)) {
      if (!compares_progress(synchronization(tree.nodes[keeper]))) continue;
      const auto children = children_of(tree, keeper);
      for (const std::size_t place : asked_) {
        const auto child = std::ranges::find(children, checks.nodes()[place]);
        if (child == children.end()) continue;
        used_.push_back({place, keeper, static_cast<std::size_t>(child - children.begin())});
      }
    }
  }
  room_.reserve(2 * EntryComparison::kLongest);
}

void LiveProperties::before_tick(Ticker& ticker) {
  ticker.keep_moments();
  if (!asked_.empty()) ticker.share_progress();
  for (const std::size_t place : asked_) {
    checks_.seen()[place].progress = ticker.progress(checks_.nodes()[place]);
  }
}

std::span<const std::size_t> LiveProperties::after_tick(Ticker& ticker, std::uint64_t tick) {
  const auto seen = checks_.seen();
  // The numbers that a synchronized node has used replace those from before its tick.
  for (const Used& it : used_) {
    if (!asked_children(ticker, it.keeper)) continue;
    const double used = child_progress(ticker, it.keeper)[it.child];
    seen[it.place].progress = is_left_out(used) ? 0 : used;
  }
  for (std::size_t i = 0; i < writes_.size(); ++i) {
    const EntryComparison& comparison = checks_.comparisons()[i];
    const Entry& entry = ticker.blackboard().entries[comparison.entry];
    // Without a value, recordings keep the one before.
    if (writes_[i] == entry.writes() || !entry.has_value()) continue;
    writes_[i] = entry.writes();
    checks_.compared()[i] = comparison.holds_for(entry.value(), room_);
  }
  const auto see = [&](auto state_of, bool is_first) {
    for (std::size_t place = 0; place < seen.size(); ++place) {
      see_node(seen[place], state_of(checks_.nodes()[place]), is_first);
    }
  };
  std::span<const std::size_t> violated;
  const auto see_part = [&](std::span<const NodeState> states, bool is_first, bool is_last) {
    see([&](NodeIndex node) { return states[node]; }, is_first);
    violated = checks_.step(tick, {.is_first = is_first, .is_last = is_last});
  };
  if (const MomentsView moments = ticker.moments(); !moments.empty()) [[unlikely]] {
    moments.each_part(moment_, see_part);
    return violated;
  }
  see([&](NodeIndex node) { return ticker.node_state(node); }, true);
  return checks_.step(tick);
}

}  // namespace lockstep::host
