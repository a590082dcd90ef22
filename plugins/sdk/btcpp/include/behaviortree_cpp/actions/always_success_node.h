// As the tag AlwaysSuccess: also under other IDs, in place of leaves that do not exist yet.
#pragma once

#include <string>

#include "behaviortree_cpp/action_node.h"

namespace BT {

class AlwaysSuccessNode : public SyncActionNode {
 public:
  explicit AlwaysSuccessNode(const std::string& name) : SyncActionNode(name, {}) {
    setRegistrationID("AlwaysSuccess");
  }

 protected:
  NodeStatus tick() override { return NodeStatus::SUCCESS; }
};

}  // namespace BT
