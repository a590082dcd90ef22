#include "engine/cut.h"

#include <algorithm>

#include "engine/held_leaves.h"
#include "engine/leaf_call.h"
#include "engine/pace.h"
#include "engine/ticker.h"
#include "engine/tree.h"

namespace lockstep::host {

void Ticker::save_leaves(LeafBytes& into) {
  if (tree_.kept_leaves.empty()) return;
  into.resize(leaves_.size());
  leaf_room_.resize(LOCKSTEP_MOST_KEPT);
  for (const std::uint32_t place : tree_.kept_leaves) {
    const NodeIndex node = tree_.leaves[place].node;
    into[place].clear();
    if (status(node) == Status::Running && !has_to_commit(place))
      save_leaf(*this, node, leaf_room_, into[place]);
  }
}

// Nothing is left for it to do but to wait.
bool Ticker::has_to_commit(std::uint32_t place) const {
  const LeafNode& leaf = tree_.leaves[place];
  return leaf.at_cut.commits && RunView::state<CommitState>(leaf.node).has_succeeded != 0;
}

std::vector<CutLeaf> Ticker::cut_leaves() const {
  std::vector<CutLeaf> cut;
  NodeIndex end = 0;  // of the last one: what is below a node of a plugin begins with it
  for (std::uint32_t place = 0; place < leaves_.size(); ++place) {
    const NodeIndex node = tree_.leaves[place].node;
    if (node < end || status(node) != Status::Running || leaves_[place].failed()) continue;
    if (has_to_commit(place)) continue;
    cut.push_back({.place = place});
    end = nodes_[node].end;
  }
  return cut;
}

void Ticker::ask_after_cut(CutLeaf& leaf, std::string_view bytes, const lockstep_cut& cut) {
  lockstep_cut told = cut;
  told.on_resume = leaf.does == AfterCut::Failure   ? LOCKSTEP_FAILURE
                   : leaf.does == AfterCut::Success ? LOCKSTEP_SUCCESS
                                                    : 0;
  leaf.does = ask_leaf_after_cut(*this, tree_.leaves[leaf.place].node, bytes, told);
  leaf.is_asked = true;
}

void Ticker::go_on_after_cut(std::span<CutLeaf> cut) {
  held_leaves_.reset();
  state_.tolerated.clear();
  state_.out_of_range.clear();
  after_cut_.assign(leaves_.size(), AfterCut::StartsAgain);
  for (LeafSlot& leaf : leaves_) {
    leaf.set_started(false);
    leaf.out_of_range = leaf.went_on = false;
  }
  for (CutLeaf& it : cut) {
    LeafSlot& leaf = leaves_[it.place];
    const NodeIndex node = tree_.leaves[it.place].node;
    after_cut_[it.place] = it.does;
    leaf.mark(LeafSlot::kCut, it.does != AfterCut::Continues);
    leaf.set_started(it.does == AfterCut::Continues);
    if (it.does == AfterCut::Continues) {
      if (tree_.leaves[it.place].keeps_pace) state<LeafPace>(node).told = kNoPace;
      if (activity(node) == Activity::Paused) watch_held(node);
      it.progress = progress(node);
      continue;
    }
    for (NodeIndex at = node + 1; at < nodes_[node].end; ++at) {
      const NodeKind& kind = *nodes_[at].kind;
      if (state_.activity[at] != Activity::Idle && kind.forget != nullptr) kind.forget(*this, at);
      state_.activity[at] = Activity::Idle;
    }
  }
}

std::vector<CutLeaf> Ticker::go_on_after_cut() {
  std::vector<CutLeaf> cut = cut_leaves();
  go_on_after_cut(cut);
  return cut;
}

Status NodeContext::begin_after_cut(NodeIndex node) {
  leaf(node).mark(LeafSlot::kCut | LeafSlot::kHeld, false);
  switch (after_cut_[nodes_[node].params]) {
    case AfterCut::Failure:
      return Status::Failure;
    case AfterCut::Success:
      return Status::Success;
    default:
      state_.activity[node] = Activity::Idle;
      return Status::Running;
  }
}

}  // namespace lockstep::host
