// Children one after the other: what SequenceNode, FallbackNode and their reactive forms share.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/control_node.h"

namespace BT::lockstep_detail {

// Goes on to the next child after `goes_on`, from where it stands.
class LockstepRowNode : public ControlNode {
 public:
  LockstepRowNode(const std::string& name, NodeStatus goes_on, bool is_async,
                  const NodeConfig& config = {})
      : ControlNode(name, config), lockstep_goes_on_(goes_on), lockstep_is_async_(is_async) {}

  void halt() override {
    lockstep_current_ = 0;
    ControlNode::halt();
  }

 protected:
  NodeStatus tick() override {
    if (status() != NodeStatus::RUNNING) lockstep_skipped_ = 0;
    setStatus(NodeStatus::RUNNING);
    while (lockstep_current_ < childrenCount()) {
      TreeNode& child = *children_nodes_[lockstep_current_];
      const bool begins = child.status() == NodeStatus::IDLE;
      const NodeStatus result = child.executeTick();
      if (result == NodeStatus::RUNNING) return result;
      if (result == NodeStatus::SKIPPED) {
        ++lockstep_skipped_;
      } else if (result != lockstep_goes_on_) {
        return lockstep_fail(result);
      }
      ++lockstep_current_;
      if (result == lockstep_goes_on_ && lockstep_is_async_ && begins && requiresWakeUp() &&
          lockstep_current_ < childrenCount()) {
        emitWakeUpSignal();
        return NodeStatus::RUNNING;
      }
    }
    const bool is_skipped = std::exchange(lockstep_skipped_, 0) == childrenCount();
    return lockstep_end(is_skipped ? NodeStatus::SKIPPED : lockstep_goes_on_);
  }

  // A child has ended the row.
  virtual NodeStatus lockstep_fail(NodeStatus result) { return lockstep_end(result); }
  NodeStatus lockstep_end(NodeStatus result) {
    resetChildren();
    lockstep_current_ = 0;
    return result;
  }
  std::size_t lockstep_current() const { return lockstep_current_; }

 private:
  NodeStatus lockstep_goes_on_;
  bool lockstep_is_async_;
  std::size_t lockstep_current_ = 0, lockstep_skipped_ = 0;
};

// From the first child in each tick; what runs is the only one that does.
class LockstepReactiveRowNode : public ControlNode {
 public:
  LockstepReactiveRowNode(const std::string& name, NodeStatus goes_on)
      : ControlNode(name, {}), lockstep_goes_on_(goes_on) {}

  // False, as it is at first: another child may run than in the tick before.
  static void EnableException(bool enable) {
    if (enable) {
      throw LogicError(
          "a reactive node of lockstep halts the child that ran when another one runs, and never "
          "throws: EnableException(true) has no effect on it");
    }
  }

 protected:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    std::size_t skipped = 0;
    for (std::size_t i = 0; i < childrenCount(); ++i) {
      const NodeStatus result = children_nodes_[i]->executeTick();
      if (result == lockstep_goes_on_) continue;
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
    return skipped == childrenCount() ? NodeStatus::SKIPPED : lockstep_goes_on_;
  }

 private:
  NodeStatus lockstep_goes_on_;
};

}  // namespace BT::lockstep_detail
