#include "tree/advise/holding_circle.h"

#include <algorithm>

#include "base/core/pre_order.h"
#include "tree/advise/dry_run.h"

namespace lockstep::host {
namespace {

using Kind = DryNode::Kind;
using State = DryRun::State;

// Follows who waits for whom where a dry run stands still.
class Follower {
 public:
  Follower(const Definition& definition, const DryTree& tree, const DryRun& run)
      : definition_(definition), tree_(tree), run_(run), links_(tree.nodes.size()) {}

  // Every leaf that runs is held, for else it would move. So from each leads a way to another one,
  // and a way that never ends has a circle.
  std::vector<HoldingLink> circle() {
    std::vector<std::uint32_t> way;
    std::vector<bool> seen(tree_.nodes.size());
    std::uint32_t leaf = leaf_in(0);
    for (; !seen[leaf]; leaf = follow(leaf)) {
      seen[leaf] = true;
      way.push_back(leaf);
    }
    std::vector<HoldingLink> links;
    for (auto it = std::ranges::find(way, leaf); it != way.end(); ++it)
      links.push_back(links_[*it]);
    const auto first = std::ranges::min_element(links, {}, &HoldingLink::held);
    std::rotate(links.begin(), first, links.end());
    return links;
  }

 private:
  // A leaf that runs in that node, the least advanced one.
  std::uint32_t leaf_in(std::uint32_t node) const {
    while (!run_.gains(node)) node = child_of(node);
    return node;
  }

  std::uint32_t child_of(std::uint32_t node) const {
    if (tree_.nodes[node].kind == Kind::Sequence) return run_.current(node);
    std::uint32_t least = node + 1;
    for (const std::uint32_t child : children_in(tree_.nodes, node)) {
      if (run_.progress(child) < run_.progress(least)) least = child;
    }
    return least;
  }

  // The leaf that this one waits for.
  std::uint32_t follow(std::uint32_t leaf) {
    const std::uint32_t held = run_.held(leaf);
    const std::uint32_t keeper = tree_.nodes[held].keeper;
    const std::uint32_t awaited = run_.last_of(keeper);
    std::uint32_t around = awaited;
    while (run_.state(around) == State::Idle) around = tree_.nodes[around].parent;
    const bool has_begun = around == awaited;
    links_[leaf] = {.keeper = tree_.keepers[keeper].node,
                    .held = named(held),
                    .awaited = named(awaited),
                    .limit = run_.limit(keeper),
                    .sequence = has_begun ? named(awaited) : tree_.nodes[around].node,
                    .before = has_begun ? named(awaited) : tree_.nodes[run_.current(around)].node};
    return leaf_in(around);
  }

  // A barrier holds the child of a SyncProgress, which is what its author speaks of.
  std::uint32_t named(std::uint32_t node) const {
    const DryNode& it = tree_.nodes[node];
    const bool is_synchronized = tree_.keepers[it.keeper].node < definition_.nodes.front().end;
    return is_synchronized ? it.node : tree_.nodes[it.parent].node;
  }

  const Definition& definition_;
  const DryTree& tree_;
  const DryRun& run_;
  std::vector<HoldingLink> links_;  // of each leaf that was followed
};

}  // namespace

std::vector<HoldingLink> holding_circle(const Definition& definition) {
  const DryTree tree = dry_tree(definition);
  if (tree.keepers.size() < 2) return {};  // one keeper alone always ticks its last
  DryRun run(tree);
  if (!run.stands_still()) return {};
  return Follower(definition, tree, run).circle();
}

}  // namespace lockstep::host
