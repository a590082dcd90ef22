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
  DecoratorNode(const std::string& name, const NodeConfig& config) : TreeNode(name, config) {}

  // It is not owned, and lives longer than the last tick and halt of this node.
  void setChild(TreeNode* child) {
    lockstep_detail::check_child(*this, child);
    if (child_node_ != nullptr) {
      throw LogicError("setChild: the decorator '" + name() + "' has a child, '" +
                       child_node_->name() + "'; a control node may have several");
    }
    child_node_ = child;
  }

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
  NodeStatus executeTick() override {
    const NodeStatus status = TreeNode::executeTick();
    if (child_node_ != nullptr && isStatusCompleted(child_node_->status()) &&
        child_node_->lockstep_is_told()) {
      child_node_->resetStatus();
    }
    return status;
  }

  NodeType type() const override { return NodeType::DECORATOR; }

  void lockstep_visit(const std::function<void(TreeNode*, std::size_t)>& visitor,
                      std::size_t depth) override {
    visitor(this, depth);
    if (child_node_ != nullptr) child_node_->lockstep_visit(visitor, depth + 1);
  }

 protected:
  NodeStatus lockstep_tick_child() {
    if (child_node_ == nullptr) {
      throw LogicError("the decorator '" + name() + "' has no child; give it one with setChild()");
    }
    return child_node_->executeTick();
  }

  TreeNode* child_node_ = nullptr;

 private:
  void lockstep_find_children(lockstep_detail::Place& place) override {
    auto children = lockstep_detail::children_at(place);
    if (children.empty()) return;
    lockstep_owned_ = std::move(children.front());
    child_node_ = lockstep_owned_.get();
  }

  std::unique_ptr<TreeNode> lockstep_owned_;
};

// What the child returns becomes what the function makes of it.
class SimpleDecoratorNode : public DecoratorNode {
 public:
  using TickFunctor = std::function<NodeStatus(NodeStatus, TreeNode&)>;
  SimpleDecoratorNode(const std::string& name, TickFunctor function, const NodeConfig& config)
      : DecoratorNode(name, config), lockstep_function_(std::move(function)) {}

 protected:
  NodeStatus tick() override { return lockstep_function_(lockstep_tick_child(), *this); }

 private:
  TickFunctor lockstep_function_;
};

}  // namespace BT
