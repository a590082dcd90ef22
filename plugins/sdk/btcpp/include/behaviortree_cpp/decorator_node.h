// A node with one child. In a tree it is the one that the tree has; a program may make nodes by
// hand and set it, without a tree.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "behaviortree_cpp/lockstep/child.h"
#include "behaviortree_cpp/tree_node.h"

namespace BT {

class DecoratorNode : public TreeNode {
 public:
  DecoratorNode(const std::string& name, const NodeConfig& config);
  ~DecoratorNode() override;

  // It is not owned, and lives longer than the last tick and halt of this node.
  void setChild(TreeNode* child);

  const TreeNode* child() const { return child_node_; }
  TreeNode* child() { return child_node_; }

  void halt() override {
    resetChild();
    resetStatus();
  }
  void haltChild() { resetChild(); }
  // Halts it if it runs; it is idle then.
  void resetChild() {
    if (child_node_ == nullptr) return;
    if (child_node_->status() == NodeStatus::RUNNING) child_node_->haltNode();
    child_node_->resetStatus();
  }

  // A child that has completed in it begins again.
  NodeStatus executeTick() override;

  NodeType type() const override { return NodeType::DECORATOR; }

  void lockstep_visit(const std::function<void(TreeNode*, std::size_t)>& visitor,
                      std::size_t depth) override;

 protected:
  NodeStatus lockstep_tick_child() {
    if (child_node_ == nullptr) lockstep_refuse_no_child();
    return child_node_->executeTick();
  }

  TreeNode* child_node_ = nullptr;

 private:
  [[noreturn]] void lockstep_refuse_no_child() const;
  void lockstep_find_children(lockstep_detail::Place& place) override;

  std::unique_ptr<TreeNode> lockstep_owned_;
};

// The function makes its result from what the child returns.
class SimpleDecoratorNode : public DecoratorNode {
 public:
  using TickFunctor = std::function<NodeStatus(NodeStatus, TreeNode&)>;
  SimpleDecoratorNode(const std::string& name, TickFunctor function, const NodeConfig& config);
  ~SimpleDecoratorNode() override;

 protected:
  NodeStatus tick() override;

 private:
  TickFunctor lockstep_function_;
};

}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/decorator_node.h"  // IWYU pragma: export
#endif
