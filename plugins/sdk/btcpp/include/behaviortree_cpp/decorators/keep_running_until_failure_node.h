// As the tag KeepRunningUntilFailure, for classes that derive from it.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

class KeepRunningUntilFailureNode : public DecoratorNode {
 public:
  explicit KeepRunningUntilFailureNode(const std::string& name) : DecoratorNode(name, {}) {}

 protected:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = child_node_->executeTick();
    if (isStatusCompleted(result)) resetChild();
    return result == NodeStatus::FAILURE ? result : NodeStatus::RUNNING;
  }
};

}  // namespace BT
