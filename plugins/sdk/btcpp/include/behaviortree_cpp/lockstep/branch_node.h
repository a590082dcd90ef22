// A condition that chooses a branch: what IfThenElseNode and WhileDoElseNode share.
#pragma once

#include <string>

#include "behaviortree_cpp/control_node.h"

namespace BT::lockstep_detail {

class LockstepBranchNode : public ControlNode {
 public:
  LockstepBranchNode(const std::string& name, const char* id) : ControlNode(name, {}) {
    setRegistrationID(id);
  }

 protected:
  static constexpr std::size_t kLockstepThen = 1, kLockstepElse = 2;

  void lockstep_check_children() const {
    if (childrenCount() == 2 || childrenCount() == 3) return;
    lockstep_refuse_children(": it has a condition, a branch, and perhaps another one");
  }
  NodeStatus lockstep_ask() {
    const NodeStatus answer = children_nodes_.front()->executeTick();
    if (answer == NodeStatus::SKIPPED) {
      throw LogicError(registrationName() + " '" + name() +
                       "': its condition was skipped, so no branch can be chosen");
    }
    return answer;
  }
  // 0: there is none.
  std::size_t lockstep_branch_of(NodeStatus answer) const {
    if (answer == NodeStatus::SUCCESS) return kLockstepThen;
    return childrenCount() > kLockstepElse ? kLockstepElse : 0;
  }
  // All children are reset, also when the branch was skipped.
  NodeStatus lockstep_tick_branch(std::size_t branch) {
    const NodeStatus result =
        branch == 0 ? NodeStatus::FAILURE : children_nodes_[branch]->executeTick();
    if (result != NodeStatus::RUNNING) resetChildren();
    return result;
  }
};

}  // namespace BT::lockstep_detail
