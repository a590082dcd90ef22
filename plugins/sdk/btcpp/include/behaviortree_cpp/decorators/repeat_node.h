// As the tag Repeat.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/again_node.h"

namespace BT {

class RepeatNode : public lockstep_detail::LockstepAgainNode {
 public:
  RepeatNode(const std::string& name, int count)
      : LockstepAgainNode(name, count, NodeStatus::SUCCESS, "Repeat") {}
  RepeatNode(const std::string& name, const NodeConfig& config)
      : LockstepAgainNode(name, config, NodeStatus::SUCCESS, "Repeat", "num_cycles") {}
  static PortsList providedPorts() {
    return {InputPort<int>("num_cycles",
                           "how often the child is ticked to its success; -1: for "
                           "ever")};
  }
};

}  // namespace BT
