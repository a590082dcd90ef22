// The part of Ticker::fold that no NodeKind::fold does.
#include <algorithm>

#include "engine/blackboard.h"
#include "engine/groups.h"
#include "engine/ticker.h"

namespace lockstep::host {
namespace {

// How often an entry was written is looked at by a few nodes. An entry that may be removed begins
// at 0 again, so the counts of those are kept as they are.
bool counts_writes(const Tree& tree, std::uint32_t slot) {
  return std::ranges::any_of(tree.nodes, [&](const Node& node) {
    return node.kind->counts_writes && tree.ports[node.params].slot == slot;
  });
}

bool has_member(const Tree& tree, NodeIndex first, NodeIndex last) {
  return std::ranges::any_of(tree.members, [&](const Member& member) {
    return first <= member.node && member.node < last;
  });
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
  state_.tick_number = 0;
  state_.now = Nanoseconds(0);
}

// Its next tick would do so. A barrier looks at the members below a node that has ended.
void Ticker::forget_below_ended() {
  for (NodeIndex node = 0; node < nodes_[0].end; ++node) {
    if (!has_ended(status(node)) || nodes_[node].end == node + 1) continue;
    if (has_member(tree_, node, nodes_[node].end)) continue;
    forget_descendants(node);
    node = nodes_[node].end - 1;
  }
}

// Parameters are read again, so they need no counts.
void Ticker::fold_entries() {
  for (std::uint32_t slot = 0; slot < board_.entries.size(); ++slot) {
    std::uint32_t& writes = board_.entries[slot].writes;
    if (writes != 0 && !counts_writes(tree_, slot)) writes = 0;
  }
  parameters_.reset();
}

}  // namespace lockstep::host
