// As the tag TryCatch.
#pragma once

#include <string>

#include "behaviortree_cpp/control_node.h"

namespace BT {

// All children but the last as a Sequence. After a failure the last one is ticked to its end.
class TryCatchNode : public ControlNode {
 public:
  TryCatchNode(const std::string& name, const NodeConfig& config) : ControlNode(name, config) {
    setRegistrationID("TryCatch");
  }
  static PortsList providedPorts() {
    return {InputPort<bool>("catch_on_halt", false,
                            "tick the last child once when the node is halted while another one "
                            "runs")};
  }

  void halt() override {
    const bool tries = status() == NodeStatus::RUNNING && lockstep_current_ + 1 < childrenCount();
    lockstep_begin();
    if (tries && getInput<bool>("catch_on_halt").value_or(false)) {
      for (std::size_t i = 0; i + 1 < childrenCount(); ++i) haltChild(i);
      children_nodes_.back()->executeTick();
    }
    ControlNode::halt();
  }

 protected:
  NodeStatus tick() override {
    if (childrenCount() < 2) {
      lockstep_refuse_children(": it has some to try, and a last one");
    }
    if (status() != NodeStatus::RUNNING) lockstep_begin();
    setStatus(NodeStatus::RUNNING);
    const std::size_t last = childrenCount() - 1;
    while (lockstep_current_ < last) {
      const NodeStatus result = children_nodes_[lockstep_current_]->executeTick();
      if (result == NodeStatus::RUNNING) return result;
      if (result == NodeStatus::FAILURE) {
        resetChildren();
        lockstep_current_ = last;
        return lockstep_catch();
      }
      if (result == NodeStatus::SKIPPED) ++lockstep_skipped_;
      if (++lockstep_current_ < last) continue;
      return lockstep_end(lockstep_skipped_ == last ? NodeStatus::SKIPPED : NodeStatus::SUCCESS);
    }
    return lockstep_catch();
  }

 private:
  void lockstep_begin() { lockstep_current_ = lockstep_skipped_ = 0; }
  NodeStatus lockstep_catch() {
    const NodeStatus result = children_nodes_.back()->executeTick();
    return result == NodeStatus::RUNNING ? result : lockstep_end(NodeStatus::FAILURE);
  }
  NodeStatus lockstep_end(NodeStatus result) {
    resetChildren();
    lockstep_begin();
    return result;
  }

  std::size_t lockstep_current_ = 0, lockstep_skipped_ = 0;
};

}  // namespace BT
