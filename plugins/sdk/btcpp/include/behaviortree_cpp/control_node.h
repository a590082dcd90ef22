// A node that decides which of its children are ticked.
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
  ControlNode(const std::string& name, const NodeConfig& config) : TreeNode(name, config) {}

  std::size_t childrenCount() const { return children_nodes_.size(); }
  const std::vector<TreeNode*>& children() const { return children_nodes_; }
  const TreeNode* child(std::size_t index) const { return children_nodes_.at(index); }

  void halt() override {
    resetChildren();
    resetStatus();
  }
  void haltChildren() { resetChildren(); }
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

 protected:
  std::vector<TreeNode*> children_nodes_;

 private:
  void lockstep_find_children(lockstep_detail::Place& place) override {
    lockstep_owned_ = lockstep_detail::children_at(place);
    for (const auto& child : lockstep_owned_) children_nodes_.push_back(child.get());
  }

  std::vector<std::unique_ptr<TreeNode>> lockstep_owned_;
};

}  // namespace BT
