// As the tag RunOnce.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

class RunOnceNode : public DecoratorNode {
 public:
  RunOnceNode(const std::string& name, const NodeConfig& config) : DecoratorNode(name, config) {
    setRegistrationID("RunOnce");
  }
  static PortsList providedPorts() {
    return {InputPort<bool>("then_skip", true, "after that: skipped, or the same result again")};
  }

 protected:
  NodeStatus tick() override {
    if (isStatusCompleted(lockstep_result_)) {
      return getInput<bool>("then_skip").value_or(true) ? NodeStatus::SKIPPED : lockstep_result_;
    }
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = lockstep_tick_child();
    if (isStatusCompleted(result)) {
      lockstep_result_ = result;
      resetChild();
    }
    return result;
  }

 private:
  NodeStatus lockstep_result_ = NodeStatus::IDLE;
};

}  // namespace BT
