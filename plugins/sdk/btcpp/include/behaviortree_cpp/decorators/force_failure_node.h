// As the tag ForceFailure.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

class ForceFailureNode : public DecoratorNode {
 public:
  explicit ForceFailureNode(const std::string& name) : DecoratorNode(name, {}) {
    setRegistrationID("ForceFailure");
  }

 protected:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = lockstep_tick_child();
    return isStatusCompleted(result) ? NodeStatus::FAILURE : result;
  }
};

}  // namespace BT
