#include "verify/read_holds.h"

#include <algorithm>

#include "engine/synchronized.h"

namespace lockstep::host {

ReadHolds::ReadHolds(const Tree& tree, const std::vector<bool>& leaves,
                     const std::vector<bool>& watched)
    : tree_(tree) {
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const Node& it = tree.nodes[node];
    const bool is_leaf = tree.labels[node].type->leaf != nullptr;
    by_itself_.push_back((is_leaf ? leaves[it.params] : it.kind->reads_own_hold) ||
                         (!watched.empty() && watched[node]));
  }
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (!tree.nodes[node].kind->passes_over_branches) continue;
    for (NodeIndex at = tree.nodes[node + 1].end; at < tree.nodes[node].end; ++at) {
      by_itself_[at] = true;
    }
  }
  for (const Member& it : tree.members) {
    if (tree.nodes[it.group].kind->reads_hold_of_members) by_a_group_.push_back(it.node);
  }
  std::ranges::sort(by_a_group_);
}

// Nobody looks below a node that stays held.
void ReadHolds::forget_others(const Ticker& ticker, std::vector<Activity>& activity) const {
  for (NodeIndex node = 0; node < activity.size();) {
    if (activity[node] == Activity::Paused) {
      if (by_itself_[node] || is_read_by_group(ticker, node)) {
        node = tree_.nodes[node].end;
        continue;
      }
      activity[node] = Activity::Running;
    }
    ++node;
  }
}

// Whether a group reads of some member that a synchronized parallel holds it with this node. All
// that runs below a held node is held, so only the outermost one is asked.
bool ReadHolds::is_read_by_group(const Ticker& ticker, NodeIndex node) const {
  if (by_a_group_.empty() || ticker.held(tree_.labels[node].parent)) return false;
  const auto first = std::ranges::lower_bound(by_a_group_, node);
  const auto last = std::ranges::lower_bound(by_a_group_, tree_.nodes[node].end);
  return std::any_of(first, last,
                     [&](NodeIndex member) { return is_held_by_parallel(ticker, member); });
}

}  // namespace lockstep::host
