// A child of a control node or decorator: any node of the tree, which the host ticks.
#pragma once

#include <lockstep/leaf.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/tree_node.h"

namespace BT::lockstep_detail {

class Child final : public TreeNode {
 public:
  Child(Place& parent, std::uint32_t index)
      : TreeNode(parent.node->child_name(parent.caller, index), {}),
        parent_(parent),
        index_(index) {
    setRegistrationID(parent.node->child_id(parent.caller, index));
  }

  NodeType type() const override { return NodeType::UNDEFINED; }
  void lockstep_visit(const std::function<void(TreeNode*, std::size_t)>& /*visitor*/,
                      std::size_t /*depth*/) override {
    throw LogicError("node '" + name() +
                     "' is visited by way of its parent: a node of a tree knows no more than its "
                     "children; begin with the rootNode() of the BT::Tree");
  }

  // One that has completed and was not reset goes on from there.
  NodeStatus executeTick() override {
    const bool begins = std::exchange(is_reset_, false);
    const lockstep_children& children = *parent_.children;
    return static_cast<NodeStatus>(begins ? children.tick(parent_.caller, index_)
                                          : children.tick_unreset(parent_.caller, index_));
  }

 private:
  NodeStatus tick() override { return executeTick(); }
  // Outside of the parent's tick the host has halted it.
  void halt() override {
    if (parent_.is_in_tick() && host_status() == NodeStatus::RUNNING) {
      parent_.children->halt(parent_.caller, index_);
    }
  }
  NodeStatus host_status() const {
    const auto status = static_cast<NodeStatus>(parent_.children->status(parent_.caller, index_));
    return status == NodeStatus::SKIPPED ? NodeStatus::IDLE : status;
  }
  NodeStatus lockstep_shown_status() const override {
    return is_reset_ ? NodeStatus::IDLE : host_status();
  }
  void lockstep_forget_status() override { is_reset_ = true; }

  Place& parent_;
  std::uint32_t index_;
  bool is_reset_ = true;
};

// For a node that a program makes by hand.
void check_child(const TreeNode& parent, const TreeNode* child);

// The children of a node that was made in a tree, in order.
std::vector<std::unique_ptr<TreeNode>> children_at(Place& place);

}  // namespace BT::lockstep_detail

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/child.h"  // IWYU pragma: export
#endif
