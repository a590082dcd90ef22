#include "engine/ticker.h"

namespace lockstep {

Status Ticker::tick_root(Nanoseconds now) {
  set_now(now);
  ++state_.tick_number;
  if (!held_leaves_.empty()) [[unlikely]]
    held_leaves_.look(*this);
  if (tree_.groups.empty()) [[likely]]
    return tick(0);
  return tick_with_groups();
}

Status Ticker::tick_root_again() {
  return tick(0);
}

// A group is idle when its common ancestor does not run: the ancestor's next tick begins an
// activation, and the group begins again with it. Whether the tick reached the group, its members
// say.
Status Ticker::tick_with_groups() {
  const auto rests = [this](const Group& group) {
    return status(group.ancestor) != Status::Running;
  };
  for (const std::uint32_t number : tree_.group_order) {
    const Group& group = tree_.groups[number];
    Activity& activity = state_.activity[group.node];
    if (rests(group)) activity = Activity::Idle;
    const Status status = nodes_[group.node].kind->tick(*this, group.node);
    activity = static_cast<Activity>(state_.faulted ? Status::Running : status);
  }
  const Status result = tick(0);
  for (const Group& group : tree_.groups) {
    Activity& activity = state_.activity[group.node];
    if (rests(group) && activity == Activity::Running) activity = Activity::Idle;
  }
  return result;
}

void Ticker::halt_all() {
  state_.in_last_halt = true;
  halt_range(0, static_cast<NodeIndex>(tree_.nodes.size()));
  state_.in_last_halt = false;
}

void Ticker::reset() {
  state_.reset();
  parameters_.reset();
  names_.reset();
  scripts_.reset();
  held_leaves_.reset();
  for (LeafSlot& leaf : leaves_) leaf.out_of_range = leaf.went_on = false;
}

}  // namespace lockstep
