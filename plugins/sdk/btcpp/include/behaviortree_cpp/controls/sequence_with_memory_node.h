// As the tag SequenceWithMemory, for classes that derive from it.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class SequenceWithMemory : public detail::RowNode {
 public:
  explicit SequenceWithMemory(const std::string& name) : RowNode(name, NodeStatus::SUCCESS, true) {}

  // It keeps its place.
  void halt() override { ControlNode::halt(); }

 private:
  NodeStatus fail(NodeStatus result) override {
    for (std::size_t i = current(); i < childrenCount(); ++i) haltChild(i);
    return result;
  }
};

}  // namespace BT
