// The functions of behavior_tree.h. Included by it.
#pragma once

#include <ostream>
#include <string>

#include "behaviortree_cpp/behavior_tree.h"

namespace BT {

namespace lockstep_detail {

LOCKSTEP_BTCPP_INLINE void visit_all(TreeNode& first, const NodeTree::Visitor& visitor) {
  if (const NodeTree* const tree = first.lockstep_tree()) return tree->visit(first, visitor);
  first.lockstep_visit(visitor, 0);
}

}  // namespace lockstep_detail
LOCKSTEP_BTCPP_INLINE void applyRecursiveVisitor(TreeNode* root,
                                                 const std::function<void(TreeNode*)>& visitor) {
  if (root == nullptr) throw LogicError("applyRecursiveVisitor: the node is a null pointer");
  lockstep_detail::visit_all(*root, [&visitor](TreeNode* node, std::size_t) { visitor(node); });
}

LOCKSTEP_BTCPP_INLINE void applyRecursiveVisitor(
    const TreeNode* root, const std::function<void(const TreeNode*)>& visitor) {
  auto* const node = const_cast<TreeNode*>(root);  // NOLINT: the visitor gets it as it was given
  applyRecursiveVisitor(node, [&visitor](TreeNode* it) { visitor(it); });
}

LOCKSTEP_BTCPP_INLINE void printTreeRecursively(const TreeNode* root, std::ostream& out) {
  if (root == nullptr) throw LogicError("printTreeRecursively: the node is a null pointer");
  out << "----------------" << std::endl;
  auto* const node = const_cast<TreeNode*>(root);  // NOLINT: it is only read
  lockstep_detail::visit_all(*node, [&out](const TreeNode* it, std::size_t depth) {
    out << std::string(3 * depth, ' ') << it->name() << std::endl;
  });
  out << "----------------" << std::endl;
}

}  // namespace BT
