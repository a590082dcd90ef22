#include "engine/groups.h"

#include "engine/node_context.h"

namespace lockstep::host {

void Groups::tick(NodeContext& context) {
  for (const std::uint32_t number : tree_.group_order) {
    const Group& group = tree_.groups[number];
    Activity& activity = state_.activity[group.node];
    if (rests(group)) activity = Activity::Idle;
    const Status status = tree_.nodes[group.node].kind->tick(context, group.node);
    activity = static_cast<Activity>(state_.faulted ? Status::Running : status);
  }
}

void Groups::end_tick() {
  for (const Group& group : tree_.groups) {
    Activity& activity = state_.activity[group.node];
    if (rests(group) && activity == Activity::Running) activity = Activity::Idle;
  }
}

void Groups::fold() {
  for (const Group& group : tree_.groups) {
    if (rests(group)) state_.activity[group.node] = Activity::Idle;
  }
}

}  // namespace lockstep::host
