// As the tag RetryUntilSuccessful.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/again_node.h"

namespace BT {

class RetryNode : public lockstep_detail::LockstepAgainNode {
 public:
  RetryNode(const std::string& name, int count)
      : LockstepAgainNode(name, count, NodeStatus::FAILURE, "RetryUntilSuccessful") {}
  RetryNode(const std::string& name, const NodeConfig& config)
      : LockstepAgainNode(name, config, NodeStatus::FAILURE, "RetryUntilSuccessful",
                          "num_attempts") {}
  static PortsList providedPorts() {
    return {InputPort<int>("num_attempts",
                           "how often a child that fails is ticked; -1: until it "
                           "succeeds")};
  }
};

}  // namespace BT
