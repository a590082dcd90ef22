// All classes of nodes, and functions over all nodes below one.
#pragma once

#include <functional>
#include <iostream>
#include <string>

#include "behaviortree_cpp/action_node.h"     // IWYU pragma: export
#include "behaviortree_cpp/condition_node.h"  // IWYU pragma: export
#include "behaviortree_cpp/control_node.h"    // IWYU pragma: export
#include "behaviortree_cpp/decorator_node.h"  // IWYU pragma: export
#include "behaviortree_cpp/lockstep/nodes.h"  // IWYU pragma: export
#include "behaviortree_cpp/tree_node.h"       // IWYU pragma: export

namespace BT {

template <class T>
constexpr NodeType getType() {
  if constexpr (std::is_base_of_v<ActionNodeBase, T>) {
    return NodeType::ACTION;
  } else if constexpr (std::is_base_of_v<ConditionNode, T>) {
    return NodeType::CONDITION;
  } else if constexpr (std::is_base_of_v<ControlNode, T>) {
    return NodeType::CONTROL;
  } else if constexpr (std::is_base_of_v<SubTreeNode, T>) {
    return NodeType::SUBTREE;
  } else if constexpr (std::is_base_of_v<DecoratorNode, T>) {
    return NodeType::DECORATOR;
  } else {
    return NodeType::UNDEFINED;
  }
}

namespace lockstep_detail {

// The node and all below it, in order.
void visit_all(TreeNode& first, const NodeTree::Visitor& visitor);

}  // namespace lockstep_detail

// Calls the visitor for the node and all below it: of nodes that a program has made by hand, or of
// the rootNode() of a BT::Tree.
void applyRecursiveVisitor(TreeNode* root, const std::function<void(TreeNode*)>& visitor);
void applyRecursiveVisitor(const TreeNode* root,
                           const std::function<void(const TreeNode*)>& visitor);

// The names of the node and all below it, each below its parent.
void printTreeRecursively(const TreeNode* root, std::ostream& out = std::cout);

}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/behavior_tree.h"  // IWYU pragma: export
#endif
