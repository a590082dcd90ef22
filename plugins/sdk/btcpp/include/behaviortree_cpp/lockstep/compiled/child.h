// The functions of child.h. Included by it.
#pragma once

#include "behaviortree_cpp/lockstep/child.h"

namespace BT::lockstep_detail {

LOCKSTEP_BTCPP_INLINE void check_child(const TreeNode& parent, const TreeNode* child) {
  if (child != nullptr && child != &parent) return;
  throw LogicError("the child that '" + parent.name() + "' is given is " +
                   (child == nullptr ? "a null pointer" : "the node itself"));
}

LOCKSTEP_BTCPP_INLINE std::vector<std::unique_ptr<TreeNode>> children_at(Place& place) {
  std::vector<std::unique_ptr<TreeNode>> children;
  for (std::uint32_t i = 0; place.node->child_id(place.caller, i) != nullptr; ++i) {
    children.push_back(std::make_unique<Child>(place, i));
  }
  return children;
}

}  // namespace BT::lockstep_detail
