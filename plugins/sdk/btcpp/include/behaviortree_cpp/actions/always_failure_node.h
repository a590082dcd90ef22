// As the tag AlwaysFailure: also under other IDs, in place of leaves that do not exist yet.
#pragma once

#include <string>

#include "behaviortree_cpp/action_node.h"

namespace BT {

class AlwaysFailureNode : public SyncActionNode {
 public:
  explicit AlwaysFailureNode(const std::string& name) : SyncActionNode(name, {}) {
    setRegistrationID("AlwaysFailure");
  }

 protected:
  NodeStatus tick() override { return NodeStatus::FAILURE; }
};

}  // namespace BT
