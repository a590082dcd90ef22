// As the tag Inverter.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

class InverterNode : public DecoratorNode {
 public:
  explicit InverterNode(const std::string& name) : DecoratorNode(name, {}) {
    setRegistrationID("Inverter");
  }

 protected:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = lockstep_tick_child();
    if (result == NodeStatus::SUCCESS) return NodeStatus::FAILURE;
    return result == NodeStatus::FAILURE ? NodeStatus::SUCCESS : result;
  }
};

}  // namespace BT
