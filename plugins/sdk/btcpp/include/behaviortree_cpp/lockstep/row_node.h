// Children one after the other: what SequenceNode, FallbackNode and their reactive forms share.
#pragma once

#include <string>

#include "behaviortree_cpp/control_node.h"

namespace BT::detail {

// Goes on to the next child after `goes_on`, from where it stands.
class RowNode : public ControlNode {
 public:
  RowNode(const std::string& name, NodeStatus goes_on, bool is_async, const NodeConfig& config = {})
      : ControlNode(name, config), goes_on_(goes_on), is_async_(is_async) {}

  void halt() override {
    current_ = 0;
    ControlNode::halt();
  }

 protected:
  NodeStatus tick() override {
    if (status() == NodeStatus::IDLE) skipped_ = 0;
    setStatus(NodeStatus::RUNNING);
    while (current_ < childrenCount()) {
      TreeNode& child = *children_nodes_[current_];
      const bool begins = child.status() == NodeStatus::IDLE;
      const NodeStatus result = child.executeTick();
      if (result == NodeStatus::RUNNING) return result;
      if (result == NodeStatus::SKIPPED) {
        ++skipped_;
      } else if (result != goes_on_) {
        return fail(result);
      }
      ++current_;
      if (result == goes_on_ && is_async_ && begins && current_ < childrenCount()) {
        emitWakeUpSignal();
        return NodeStatus::RUNNING;
      }
    }
    return end(skipped_ == childrenCount() ? NodeStatus::SKIPPED : goes_on_);
  }

  // A child has ended the row.
  virtual NodeStatus fail(NodeStatus result) { return end(result); }
  NodeStatus end(NodeStatus result) {
    resetChildren();
    current_ = 0;
    return result;
  }
  std::size_t current() const { return current_; }

 private:
  NodeStatus goes_on_;
  bool is_async_;
  std::size_t current_ = 0, skipped_ = 0;
};

// From the first child in each tick; what runs is the only one that does.
class ReactiveRowNode : public ControlNode {
 public:
  ReactiveRowNode(const std::string& name, NodeStatus goes_on)
      : ControlNode(name, {}), goes_on_(goes_on) {}

 protected:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    std::size_t skipped = 0;
    for (std::size_t i = 0; i < childrenCount(); ++i) {
      const NodeStatus result = children_nodes_[i]->executeTick();
      if (result == goes_on_) continue;
      if (result == NodeStatus::SKIPPED) {
        ++skipped;
        haltChild(i);
        continue;
      }
      for (std::size_t other = 0; other < childrenCount(); ++other) {
        if (other != i || result != NodeStatus::RUNNING) haltChild(other);
      }
      return result;
    }
    resetChildren();
    return skipped == childrenCount() ? NodeStatus::SKIPPED : goes_on_;
  }

 private:
  NodeStatus goes_on_;
};

}  // namespace BT::detail
