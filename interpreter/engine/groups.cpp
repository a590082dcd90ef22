#include "engine/groups.h"

#include "engine/node_context.h"

namespace lockstep::host {

// Barriers come first (Tree::group_order): a member that waits at one must not own resources, which
// others could use until it opens.
void Groups::tick(NodeContext& context) {
  for (const std::uint32_t number : tree_.group_order) {
    const Group& group = tree_.groups[number];
    Activity& activity = state_.activity[group.node];
    if (rests(group)) activity = Activity::Idle;
    const Status status = tree_.nodes[group.node].kind->tick(context, group.node);
    activity = static_cast<Activity>(state_.faulted ? Status::Running : status);
  }
}

// The tick of the root may have ended the ancestor. Without this, a view would show a barrier that
// runs beside a tree that does not.
void Groups::end_tick() {
  for (const Group& group : tree_.groups) {
    Activity& activity = state_.activity[group.node];
    if (rests(group) && activity == Activity::Running) activity = Activity::Idle;
  }
}

// Only end_tick makes one idle: its own tick does not.
void Groups::reopen_tick() {
  for (const Group& group : tree_.groups) {
    Activity& activity = state_.activity[group.node];
    if (activity == Activity::Idle) activity = Activity::Running;
  }
}

// What a group was when its ancestor ended means nothing for later ticks: it begins idle. Two
// states that differ in that alone must be one, or a search for all states finds each of them
// twice.
void Groups::fold() {
  for (const Group& group : tree_.groups) {
    if (rests(group)) state_.activity[group.node] = Activity::Idle;
  }
}

}  // namespace lockstep::host
