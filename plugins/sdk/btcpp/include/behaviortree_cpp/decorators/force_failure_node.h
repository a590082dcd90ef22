// As the tag ForceFailure, for classes that derive from it.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

class ForceFailureNode : public DecoratorNode {
 public:
  explicit ForceFailureNode(const std::string& name) : DecoratorNode(name, {}) {}

 protected:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = child_node_->executeTick();
    return isStatusCompleted(result) ? NodeStatus::FAILURE : result;
  }
};

}  // namespace BT
