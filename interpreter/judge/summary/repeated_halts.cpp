#include "judge/summary/repeated_halts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "base/core/wording.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kTogether = sizeof(std::uint64_t);

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
  if (actions_.empty()) return;
  first_ = actions_.front().node;
  before_.resize(actions_.back().node - first_ + 1);
}

// Most nodes are as they were: eight are looked at together.
void RepeatedHalts::after_tick(const Moment& moment, const TickReport&) {
  const auto now = moment.activity.subspan(first_, before_.size());
  for (std::size_t place = 0; place < now.size(); place += kTogether) {
    const std::size_t count = std::min(kTogether, now.size() - place);
    if (count == kTogether && std::memcmp(&before_[place], &now[place], kTogether) == 0) continue;
    for (std::size_t i = place; i < place + count; ++i) look(moment, i);
  }
}

void RepeatedHalts::look(const Moment& moment, std::size_t place) {
  const auto node = static_cast<NodeIndex>(first_ + place);
  const Status was = status_of(std::exchange(before_[place], moment.activity[node]));
  if (was != Status::Running || moment.status(node) != Status::Idle) return;
  const auto action = std::ranges::lower_bound(actions_, node, {}, &Action::node);
  if (action != actions_.end() && action->node == node) note_halt(moment, *action);
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
