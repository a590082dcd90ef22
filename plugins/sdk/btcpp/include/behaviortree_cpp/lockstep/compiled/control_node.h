// The functions of control_node.h. Included by it.
#pragma once

#include <string>

#include "behaviortree_cpp/control_node.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE ControlNode::ControlNode(const std::string& name, const NodeConfig& config)
    : TreeNode(name, config) {}
LOCKSTEP_BTCPP_INLINE ControlNode::~ControlNode() = default;
LOCKSTEP_BTCPP_INLINE void ControlNode::lockstep_visit(
    const std::function<void(TreeNode*, std::size_t)>& visitor, std::size_t depth) {
  visitor(this, depth);
  for (TreeNode* const child : children_nodes_) child->lockstep_visit(visitor, depth + 1);
}
LOCKSTEP_BTCPP_INLINE void ControlNode::lockstep_refuse_children(const std::string& wanted) const {
  throw LogicError(registrationName() + " '" + name() + "' has " + std::to_string(childrenCount()) +
                   " children" + wanted);
}
LOCKSTEP_BTCPP_INLINE void ControlNode::lockstep_find_children(lockstep_detail::Place& place) {
  lockstep_owned_ = lockstep_detail::children_at(place);
  for (const auto& child : lockstep_owned_) children_nodes_.push_back(child.get());
}

}  // namespace BT
