// The groups of a run: barriers and pools beside the tree (Tree::groups). They are ticked before
// the root. A group is idle when the common ancestor of its members does not run: the ancestor's
// next tick begins an activation, and the group begins again with it. Its members say whether a
// tick reached it.
#pragma once

#include "engine/run_state.h"
#include "engine/tree.h"

namespace lockstep::host {

class NodeContext;

class Groups {
 public:
  // Both must outlive this.
  Groups(const Tree& tree, RunState& state) : tree_(tree), state_(state) {}

  bool empty() const { return tree_.groups.empty(); }
  // All of them, before the root is ticked.
  void tick(NodeContext& context);
  // After the root was ticked.
  void end_tick();

  // A member was ticked: its group counts as ticked in this tick.
  void reach(NodeIndex group) { state_.last_tick[group] = state_.tick_number; }
  // A group whose common ancestor runs: Success, or Running again.
  void set_complete(NodeIndex group, bool is_complete) {
    state_.activity[group] = is_complete ? Activity::Success : Activity::Running;
  }
  // Whatever a group was, it is idle where its common ancestor does not run (Ticker::fold).
  void fold();

 private:
  bool rests(const Group& group) const {
    return status_of(state_.activity[group.ancestor]) != Status::Running;
  }

  const Tree& tree_;
  RunState& state_;
};

}  // namespace lockstep::host
