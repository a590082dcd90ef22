// As the tag ForceSuccess.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

class ForceSuccessNode : public DecoratorNode {
 public:
  explicit ForceSuccessNode(const std::string& name) : DecoratorNode(name, {}) {
    setRegistrationID("ForceSuccess");
  }

 protected:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = lockstep_tick_child();
    return isStatusCompleted(result) ? NodeStatus::SUCCESS : result;
  }
};

}  // namespace BT
