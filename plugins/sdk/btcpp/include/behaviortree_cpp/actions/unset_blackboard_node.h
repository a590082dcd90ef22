// As the tag UnsetBlackboard.
#pragma once

#include <string>

#include "behaviortree_cpp/action_node.h"
#include "behaviortree_cpp/lockstep/parameter.h"

namespace BT {

class UnsetBlackboardNode : public SyncActionNode {
 public:
  using LockstepOpens = void;  // uses entries by their names
  UnsetBlackboardNode(const std::string& name, const NodeConfig& config)
      : SyncActionNode(name, config) {
    setRegistrationID("UnsetBlackboard");
  }
  static PortsList providedPorts() {
    return {InputPort<std::string>("key", "the entry to remove")};
  }

 protected:
  NodeStatus tick() override {
    const auto key = lockstep_detail::parameter<std::string>(*this, "key");
    if (config().blackboard == nullptr) throw RuntimeError("the node has no blackboard");
    config().blackboard->lockstep_unset(key);
    return NodeStatus::SUCCESS;
  }
};

}  // namespace BT
