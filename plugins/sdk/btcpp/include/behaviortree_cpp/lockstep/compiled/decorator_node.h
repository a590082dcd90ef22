// The functions of decorator_node.h. Included by it.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE DecoratorNode::DecoratorNode(const std::string& name,
                                                   const NodeConfig& config)
    : TreeNode(name, config) {}
LOCKSTEP_BTCPP_INLINE DecoratorNode::~DecoratorNode() = default;
LOCKSTEP_BTCPP_INLINE void DecoratorNode::setChild(TreeNode* child) {
  lockstep_detail::check_child(*this, child);
  if (child_node_ != nullptr) {
    throw LogicError("setChild: the decorator '" + name() + "' has a child, '" +
                     child_node_->name() + "'; a control node may have several");
  }
  child_node_ = child;
}
LOCKSTEP_BTCPP_INLINE NodeStatus DecoratorNode::executeTick() {
  const NodeStatus status = TreeNode::executeTick();
  if (child_node_ != nullptr && isStatusCompleted(child_node_->status()) &&
      child_node_->lockstep_is_told()) {
    child_node_->resetStatus();
  }
  return status;
}
LOCKSTEP_BTCPP_INLINE void DecoratorNode::lockstep_visit(
    const std::function<void(TreeNode*, std::size_t)>& visitor, std::size_t depth) {
  visitor(this, depth);
  if (child_node_ != nullptr) child_node_->lockstep_visit(visitor, depth + 1);
}
LOCKSTEP_BTCPP_INLINE void DecoratorNode::lockstep_refuse_no_child() const {
  throw LogicError("the decorator '" + name() + "' has no child; give it one with setChild()");
}
LOCKSTEP_BTCPP_INLINE void DecoratorNode::lockstep_find_children(lockstep_detail::Place& place) {
  auto children = lockstep_detail::children_at(place);
  if (children.empty()) return;
  lockstep_owned_ = std::move(children.front());
  child_node_ = lockstep_owned_.get();
}

LOCKSTEP_BTCPP_INLINE SimpleDecoratorNode::SimpleDecoratorNode(const std::string& name,
                                                               TickFunctor function,
                                                               const NodeConfig& config)
    : DecoratorNode(name, config), lockstep_function_(std::move(function)) {}
LOCKSTEP_BTCPP_INLINE SimpleDecoratorNode::~SimpleDecoratorNode() = default;
LOCKSTEP_BTCPP_INLINE NodeStatus SimpleDecoratorNode::tick() {
  return lockstep_function_(lockstep_tick_child(), *this);
}

}  // namespace BT
