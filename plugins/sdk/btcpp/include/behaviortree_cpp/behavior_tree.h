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
inline void visit_all(TreeNode& first, const NodeTree::Visitor& visitor) {
  if (const NodeTree* const tree = first.lockstep_tree()) return tree->visit(first, visitor);
  first.lockstep_visit(visitor, 0);
}

}  // namespace lockstep_detail

// Calls the visitor for the node and all below it: of nodes that a program has made by hand, or of
// the rootNode() of a BT::Tree.
inline void applyRecursiveVisitor(TreeNode* root, const std::function<void(TreeNode*)>& visitor) {
  if (root == nullptr) throw LogicError("applyRecursiveVisitor: the node is a null pointer");
  lockstep_detail::visit_all(*root, [&visitor](TreeNode* node, std::size_t) { visitor(node); });
}
inline void applyRecursiveVisitor(const TreeNode* root,
                                  const std::function<void(const TreeNode*)>& visitor) {
  auto* const node = const_cast<TreeNode*>(root);  // NOLINT: the visitor gets it as it was given
  applyRecursiveVisitor(node, [&visitor](TreeNode* it) { visitor(it); });
}

// The names of the node and all below it, each below its parent.
inline void printTreeRecursively(const TreeNode* root, std::ostream& out = std::cout) {
  if (root == nullptr) throw LogicError("printTreeRecursively: the node is a null pointer");
  out << "----------------" << std::endl;
  auto* const node = const_cast<TreeNode*>(root);  // NOLINT: it is only read
  lockstep_detail::visit_all(*node, [&out](const TreeNode* it, std::size_t depth) {
    out << std::string(3 * depth, ' ') << it->name() << std::endl;
  });
  out << "----------------" << std::endl;
}

}  // namespace BT
