// A node that decides which of its children are ticked. In a tree they are those that the tree has;
// a program may make nodes by hand and add them, without a tree.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/lockstep/child.h"
#include "behaviortree_cpp/tree_node.h"

namespace BT {

class ControlNode : public TreeNode {
 public:
  ControlNode(const std::string& name, const NodeConfig& config);
  ~ControlNode() override;

  // It is not owned, and lives longer than the last tick and halt of this node.
  void addChild(TreeNode* child) {
    lockstep_detail::check_child(*this, child);
    children_nodes_.push_back(child);
  }

  std::size_t childrenCount() const { return children_nodes_.size(); }
  const std::vector<TreeNode*>& children() const { return children_nodes_; }
  const TreeNode* child(std::size_t index) const { return children_nodes_.at(index); }

  void halt() override {
    resetChildren();
    resetStatus();
  }
  void haltChildren() { resetChildren(); }
  [[deprecated("use haltChildren() or haltChild(index)")]] void haltChildren(std::size_t first) {
    for (std::size_t i = first; i < children_nodes_.size(); ++i) haltChild(i);
  }
  void resetChildren() {
    for (std::size_t i = 0; i < children_nodes_.size(); ++i) haltChild(i);
  }
  // Halts it if it runs; it is idle then.
  void haltChild(std::size_t index) {
    TreeNode& child = *children_nodes_.at(index);
    if (child.status() == NodeStatus::RUNNING) child.haltNode();
    child.resetStatus();
  }

  NodeType type() const final { return NodeType::CONTROL; }

  void lockstep_visit(const std::function<void(TreeNode*, std::size_t)>& visitor,
                      std::size_t depth) override;

 protected:
  // Throws; `wanted` goes on after "has 2 children".
  [[noreturn]] void lockstep_refuse_children(const std::string& wanted) const;

  std::vector<TreeNode*> children_nodes_;

 private:
  void lockstep_find_children(lockstep_detail::Place& place) override;

  std::vector<std::unique_ptr<TreeNode>> lockstep_owned_;
};

}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/control_node.h"  // IWYU pragma: export
#endif
