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
  into.answers = answers_;
  into.leaves.clear();
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const LeafSlot& leaf = leaves_[i];
    into.leaves.push_back({leaf.started(), leaf.failed(), leaf.out_of_range, leaf.went_on});
    if (!leaf.was_cut()) continue;
    into.leaves.back().was_cut = true;
    into.leaves.back().does = after_cut_[i];
  }
}

RunParts Ticker::parts() const {
  RunParts parts{state_,       board_.entries, ports_.names().made(), parameters_.state(),
                 held_leaves_, answers_};
  for (const NodeIndex node : state_.failed_leaves) {
    const std::uint32_t place = nodes_[node].params;
    if (leaves_[place].failed()) parts.failed.push_back(place);
  }
  return parts;
}

RunParts parts_of(const SavedRun& run) {
  RunParts parts{run.run, run.entries, run.named, run.parameters, run.held_leaves, run.answers};
  for (std::uint32_t place = 0; place < run.leaves.size(); ++place) {
    if (run.leaves[place].failed) parts.failed.push_back(place);
  }
  return parts;
}

namespace {

// To assign what is empty takes longer than to look, and nearly all of these are.
template <class T>
void take(T& to, const T& from) {
  if (!to.empty() || !from.empty()) to = from;
}

void take_state(RunState& to, const RunState& from) {
  to.activity = from.activity;
  to.last_tick = from.last_tick;
  to.bytes = from.bytes;
  to.now = from.now;
  to.tick_number = from.tick_number;
  to.asked_by = from.asked_by;
  to.in_last_halt = from.in_last_halt;
  to.interrupted = from.interrupted;
  if (to.faulted || from.faulted || to.fault != from.fault) to.fault = from.fault;
  to.faulted = from.faulted;
  take(to.failing, from.failing);
  take(to.ended, from.ended);
  take(to.failed_leaves, from.failed_leaves);
  take(to.tolerated, from.tolerated);
  take(to.out_of_range, from.out_of_range);
  take(to.kept_values, from.kept_values);
}

}  // namespace

// The compiled scripts of entries follow from their texts, so they need no restoring.
void Ticker::restore(const SavedRun& from) {
  shares_progress_ = false;
  take_state(state_, from.run);
  board_.entries = from.entries;  // each stays where it is
  ports_.names().restore(from.named);
  parameters_.restore(from.parameters);
  held_leaves_ = from.held_leaves;
  take(answers_, from.answers);
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const SlotState& leaf = from.leaves[i];
    leaves_[i].set_started(leaf.started);
    leaves_[i].mark(LeafSlot::kFailed, leaf.failed);
    leaves_[i].mark(LeafSlot::kCut, leaf.was_cut);
    if (leaf.was_cut) {
      after_cut_.resize(leaves_.size());
      after_cut_[i] = leaf.does;
    }
    leaves_[i].mark(LeafSlot::kHeld, held(tree_.leaves[i].node));
    leaves_[i].out_of_range = leaf.out_of_range;
    leaves_[i].went_on = leaf.went_on;
  }
}

}  // namespace lockstep::host
