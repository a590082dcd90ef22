// As the tag SequenceWithMemory.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class SequenceWithMemory : public lockstep_detail::LockstepRowNode {
 public:
  explicit SequenceWithMemory(const std::string& name)
      : LockstepRowNode(name, NodeStatus::SUCCESS, true) {
    setRegistrationID("SequenceWithMemory");
  }

  // It keeps its place.
  void halt() override { ControlNode::halt(); }  // NOLINT(bugprone-parent-virtual-call)

 private:
  NodeStatus lockstep_fail(NodeStatus result) override {
    for (std::size_t i = lockstep_current(); i < childrenCount(); ++i) haltChild(i);
    return result;
  }
};

}  // namespace BT
