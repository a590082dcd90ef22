#include "judge/summary/repeated_halts.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "base/core/wording.h"

namespace lockstep::host {
namespace {

// What takes time to reach its goal; AlwaysRunning has none.
bool can_be_cut_short(const NodeType& type) {
  return type.category == NodeCategory::Action && type.can_run && type.again == Again::Acts;
}

}  // namespace

RepeatedHalts::RepeatedHalts(Shape shape, Tell tell)
    : shape_(std::move(shape)), tell_(std::move(tell)) {
  for (NodeIndex node = 0; node < shape_.nodes.size(); ++node) {
    if (can_be_cut_short(*shape_.nodes[node].type)) actions_.push_back({.node = node});
  }
}

void RepeatedHalts::after_tick(const Moment& moment, const TickReport&) {
  for (Action& action : actions_) {
    const Status status = moment.status(action.node);
    const bool ran = std::exchange(action.runs, status == Status::Running);
    if (ran && status == Status::Idle) note_halt(moment, action);
  }
}

// Who has ended it: the lowest node around the action that the tick has reached, and the last of
// its other children that it has.
std::string RepeatedHalts::cause_of_halt(const Moment& moment, NodeIndex action) const {
  const auto& nodes = shape_.nodes;
  NodeIndex around = nodes[action].parent.value_or(action);
  while (!moment.ticked(around) && nodes[around].parent) around = *nodes[around].parent;
  std::optional<NodeIndex> last;
  for (const NodeIndex child : nodes[around].children) {
    const bool is_beside = action < child || action >= nodes[child].end;
    if (is_beside && moment.ticked(child)) last = child;
  }
  if (!last) return fmt::format("by '{}'", nodes[around].path);
  return fmt::format("when '{}' returned {}", nodes[*last].path, to_string(moment.status(*last)));
}

void RepeatedHalts::note_halt(const Moment& moment, Action& action) {
  const Nanoseconds time = moment.time;
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
                  shape_.nodes[action.node].path, kHalts, to_seconds(time - oldest),
                  cause_of_halt(moment, action.node)));
}

void RepeatedHalts::add_to(Summary& summary) const {
  CappedNotes notes("action");
  for (const Action& it : actions_) {
    if (!it.is_told) continue;
    notes.add([&] {
      return fmt::format(
          "the action '{}' was started and halted {} times, and {} times within {:g} s",
          shape_.nodes[it.node].path, it.halts, kHalts, to_seconds(kWithin));
    });
  }
  notes.append_to(summary.notes);
}

}  // namespace lockstep::host
