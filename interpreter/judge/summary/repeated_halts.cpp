#include "judge/summary/repeated_halts.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "base/core/wording.h"
#include "engine/synchronized.h"

namespace lockstep::host {
namespace {

// What takes time to reach its goal; AlwaysRunning has none.
bool can_be_cut_short(const NodeType& type) {
  return type.category == NodeCategory::Action && type.can_run && type.again == Again::Acts;
}

// Who has ended it: the lowest node around the action that the tick has reached, and the last of
// its other children that it has.
std::string cause_of_halt(const Ticker& ticker, NodeIndex action) {
  const auto& labels = ticker.tree().labels;
  NodeIndex around = labels[action].parent;
  while (!ticker.ticked(around) && labels[around].parent != around) around = labels[around].parent;
  std::optional<NodeIndex> last;
  for (const NodeIndex child : children_of(ticker.tree(), around)) {
    const bool is_beside = action < child || action >= ticker.end_of(child);
    if (is_beside && ticker.ticked(child)) last = child;
  }
  const Tree& tree = ticker.tree();
  if (!last) return fmt::format("by '{}'", tree.path(around));
  return fmt::format("when '{}' returned {}", tree.path(*last), to_string(ticker.status(*last)));
}

}  // namespace

RepeatedHalts::RepeatedHalts(const Tree& tree, Tell tell) : tree_(tree), tell_(std::move(tell)) {
  for (NodeIndex node = 0; node < tree.labels.size(); ++node) {
    if (can_be_cut_short(*tree.labels[node].type)) actions_.push_back({.node = node});
  }
}

void RepeatedHalts::after_tick(Ticker& ticker, const TickReport& report) {
  for (Action& action : actions_) {
    const Status status = ticker.status(action.node);
    const bool ran = std::exchange(action.runs, status == Status::Running);
    if (ran && status == Status::Idle) note_halt(ticker, action, report.time);
  }
}

void RepeatedHalts::note_halt(const Ticker& ticker, Action& action, Nanoseconds time) {
  action.times[action.halts++ % kHalts] = time;
  if (action.halts < kHalts || action.is_told) return;
  const Nanoseconds oldest = action.times[action.halts % kHalts];
  if (time - oldest > kWithin) return;
  action.is_told = true;
  tell_(
      action.node,
      fmt::format("the action '{}' was started and halted {} times in {:.3g} s, the last time {}. "
                  "It begins anew each time: let what decides keep its result while the action "
                  "runs, or put the action into a node with memory",
                  tree_.path(action.node), kHalts, to_seconds(time - oldest),
                  cause_of_halt(ticker, action.node)));
}

void RepeatedHalts::add_to(Summary& summary) const {
  CappedNotes notes("action");
  for (const Action& it : actions_) {
    if (!it.is_told) continue;
    notes.add([&] {
      return fmt::format(
          "the action '{}' was started and halted {} times, and {} times within {:g} s",
          tree_.path(it.node), it.halts, kHalts, to_seconds(kWithin));
    });
  }
  notes.append_to(summary.notes);
}

}  // namespace lockstep::host
