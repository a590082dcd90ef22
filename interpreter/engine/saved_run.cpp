#include "engine/saved_run.h"

#include "engine/node_ports.h"
#include "engine/ticker.h"

namespace lockstep::host {

void Ticker::save(SavedRun& into) const {
  into.run = state_;
  into.entries = board_.entries;
  into.named = ports_.names().made();
  into.parameters = parameters_.state();
  into.held_leaves = held_leaves_;
  into.leaves.clear();
  for (const LeafSlot& leaf : leaves_) {
    into.leaves.push_back({leaf.started, leaf.failed, leaf.out_of_range, leaf.went_on});
  }
}

// What is compiled of scripts in entries follows from their texts, so it needs no restoring.
void Ticker::restore(const SavedRun& from) {
  state_ = from.run;
  board_.entries = from.entries;  // each stays where it is
  ports_.names().restore(from.named);
  parameters_.restore(from.parameters);
  held_leaves_ = from.held_leaves;
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const SlotState& leaf = from.leaves[i];
    leaves_[i].started = leaf.started;
    leaves_[i].failed = leaf.failed;
    leaves_[i].out_of_range = leaf.out_of_range;
    leaves_[i].went_on = leaf.went_on;
  }
}

}  // namespace lockstep::host
