// A run that goes on in a new process: the engine is as it was, but the leaves are new objects.
#include <algorithm>

#include "engine/held_leaves.h"
#include "engine/ticker.h"
#include "engine/tree.h"

namespace lockstep::host {

std::vector<std::uint32_t> Ticker::go_on_after_cut(Status result) {
  after_cut_ = result;
  held_leaves_.reset();
  state_.tolerated.clear();
  state_.out_of_range.clear();
  std::vector<std::uint32_t> cut;
  for (std::uint32_t place = 0; place < leaves_.size(); ++place) {
    LeafSlot& leaf = leaves_[place];
    const NodeIndex node = tree_.leaves[place].node;
    leaf.set_started(false);
    leaf.out_of_range = leaf.went_on = false;
    if (status(node) != Status::Running || leaf.failed()) continue;
    leaf.mark(LeafSlot::kCut, true);
    cut.push_back(place);
    for (NodeIndex at = node + 1; at < nodes_[node].end; ++at) {
      const NodeKind& kind = *nodes_[at].kind;
      if (state_.activity[at] != Activity::Idle && kind.forget != nullptr) kind.forget(*this, at);
      state_.activity[at] = Activity::Idle;
    }
  }
  return cut;
}

Status NodeContext::begin_after_cut(NodeIndex node) {
  leaf(node).mark(LeafSlot::kCut | LeafSlot::kHeld, false);
  if (after_cut_ == Status::Running) state_.activity[node] = Activity::Idle;
  return after_cut_;
}

}  // namespace lockstep::host
