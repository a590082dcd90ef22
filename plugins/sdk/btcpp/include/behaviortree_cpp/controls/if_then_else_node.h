// As the tag IfThenElse.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/lockstep/branch_node.h"

namespace BT {

// The condition is asked until it completes; then its branch goes on to its end.
class IfThenElseNode : public lockstep_detail::LockstepBranchNode {
 public:
  explicit IfThenElseNode(const std::string& name) : LockstepBranchNode(name, "IfThenElse") {}

  void halt() override {
    lockstep_chosen_ = false;
    ControlNode::halt();
  }

 protected:
  NodeStatus tick() override {
    lockstep_check_children();
    if (status() != NodeStatus::RUNNING) lockstep_chosen_ = false;
    setStatus(NodeStatus::RUNNING);
    if (!lockstep_chosen_) {
      const NodeStatus answer = lockstep_ask();
      if (answer == NodeStatus::RUNNING) return answer;
      lockstep_branch_ = lockstep_branch_of(answer);
      lockstep_chosen_ = true;
    }
    const NodeStatus result = lockstep_tick_branch(lockstep_branch_);
    lockstep_chosen_ = result == NodeStatus::RUNNING;
    return result;
  }

 private:
  std::size_t lockstep_branch_ = 0;
  bool lockstep_chosen_ = false;
};

}  // namespace BT
