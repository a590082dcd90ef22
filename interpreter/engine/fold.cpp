// The part of Ticker::fold that no NodeKind::fold does.
#include <algorithm>
#include <utility>
#include <vector>

#include "engine/blackboard.h"
#include "engine/groups.h"
#include "engine/ticker.h"

namespace lockstep::host {
namespace {

// Whether a group, or a script of the tree, looks at a node below this one after it has ended.
bool is_looked_into(const Tree& tree, NodeIndex node) {
  const auto is_below = [&](NodeIndex other) {
    return node <= other && other < tree.nodes[node].end;
  };
  return std::ranges::any_of(tree.members,
                             [&](const Member& member) {
                               return is_below(member.node) &&
                                      tree.nodes[member.group].kind->reads_ended_members;
                             }) ||
         std::ranges::any_of(tree.readings,
                             [&](const BoundReading& it) { return is_below(it.node); });
}

}  // namespace

void Ticker::fold() {
  if (!tree_.keeps_over_skips) forget_below_ended();
  for (NodeIndex node = 0; node < tree_.nodes.size(); ++node) {
    const auto fold = nodes_[node].kind->fold;
    if (fold != nullptr) fold(*this, node);
  }
  groups_.fold();
  fold_entries();
  std::ranges::fill(state_.last_tick, 0);
  state_.ended.clear();
  state_.tick_number = 0;
  state_.now = Nanoseconds(0);
}

// Its next tick would do so.
void Ticker::forget_below_ended() {
  for (NodeIndex node = 0; node < nodes_[0].end; ++node) {
    if (!has_ended(status(node)) || nodes_[node].end == node + 1) continue;
    if (is_looked_into(tree_, node)) continue;
    forget_descendants(node);
    node = nodes_[node].end - 1;
  }
}

// Parameters are read again, so they need no counts. How often an entry was written is looked at by
// a few nodes. An entry that may be removed begins at 0 again, so the counts of those are kept as
// they are.
void Ticker::fold_entries() {
  if (board_.entries.empty()) return parameters_.reset();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> kept;  // slots, and their counts
  for (const Node& node : tree_.nodes) {
    if (!node.kind->counts_writes) continue;
    const std::uint32_t slot = tree_.ports[node.params].slot;
    if (slot < board_.entries.size()) kept.emplace_back(slot, board_.entries[slot].writes());
  }
  for (auto& entry : board_.entries) entry.count_from(0);
  for (const auto& [slot, writes] : kept) board_.entries[slot].count_from(writes);
  parameters_.reset();
}

}  // namespace lockstep::host
