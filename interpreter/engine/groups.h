// The groups of a run: barriers and pools beside the tree (Tree::groups), whose members may be
// anywhere in it. Example: <barrier name="close" barriers="0.5"/>, and a SyncProgress that names it
// around each of two hands, deep in two branches.
//
// They are ticked before the root, since all members must see one snapshot. If each member decided
// when the tick reaches it, the second one would see how far the first has moved in this tick, and
// the order of the branches would say who waits. So a group looks at all of its members and decides
// who is held; a member only reads that.
//
// A group has no parent, so its activation is that of the lowest node that all members are below:
// it is idle while that node does not run, and begins again with it. Example: with a Retry around
// both hands, the barrier is closed again in each attempt. Its members say whether a tick reached
// it.
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
  // The root is ticked again in the same period: no tick of theirs has ended yet.
  void reopen_tick();

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
