// As the tag WhileDoElse.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/branch_node.h"

namespace BT {

// The condition is asked in each tick; a branch that is not its choice any more is halted.
class WhileDoElseNode : public lockstep_detail::LockstepBranchNode {
 public:
  explicit WhileDoElseNode(const std::string& name) : LockstepBranchNode(name, "WhileDoElse") {}

 protected:
  NodeStatus tick() override {
    lockstep_check_children();
    setStatus(NodeStatus::RUNNING);
    const NodeStatus answer = lockstep_ask();
    if (answer == NodeStatus::RUNNING) return answer;
    const std::size_t branch = lockstep_branch_of(answer);
    for (std::size_t i = kLockstepThen; i < childrenCount(); ++i) {
      if (i != branch) haltChild(i);
    }
    return lockstep_tick_branch(branch);
  }
};

}  // namespace BT
