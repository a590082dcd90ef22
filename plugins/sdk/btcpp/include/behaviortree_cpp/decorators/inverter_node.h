// As the tag Inverter, for classes that derive from it.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

class InverterNode : public DecoratorNode {
 public:
  explicit InverterNode(const std::string& name) : DecoratorNode(name, {}) {}

 protected:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = child_node_->executeTick();
    if (result == NodeStatus::SUCCESS) return NodeStatus::FAILURE;
    return result == NodeStatus::FAILURE ? NodeStatus::SUCCESS : result;
  }
};

}  // namespace BT
