// As the tag KeepRunningUntilFailure.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

class KeepRunningUntilFailureNode : public DecoratorNode {
 public:
  explicit KeepRunningUntilFailureNode(const std::string& name) : DecoratorNode(name, {}) {
    setRegistrationID("KeepRunningUntilFailure");
  }

 protected:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = lockstep_tick_child();
    if (isStatusCompleted(result)) resetChild();
    return result == NodeStatus::FAILURE ? result : NodeStatus::RUNNING;
  }
};

}  // namespace BT
