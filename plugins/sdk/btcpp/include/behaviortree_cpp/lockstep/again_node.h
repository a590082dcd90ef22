// A child that is ticked again and again: what RepeatNode and RetryNode share.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT::lockstep_detail {

// As often as its port says, -1 for ever, as long as the child returns `goes_on`.
class LockstepAgainNode : public DecoratorNode {
 public:
  LockstepAgainNode(const std::string& name, const NodeConfig& config, NodeStatus goes_on,
                    const char* port)
      : DecoratorNode(name, config), lockstep_goes_on_(goes_on), lockstep_port_(port) {}
  LockstepAgainNode(const std::string& name, int most, NodeStatus goes_on)
      : DecoratorNode(name, {}), lockstep_goes_on_(goes_on), lockstep_most_(most) {}

  void halt() override {
    lockstep_count_ = 0;
    DecoratorNode::halt();
  }

 protected:
  NodeStatus tick() override {
    lockstep_read_most();
    setStatus(NodeStatus::RUNNING);
    while (lockstep_count_ < lockstep_most_ || lockstep_most_ == -1) {
      const bool begins = child_node_->status() == NodeStatus::IDLE;
      const NodeStatus result = child_node_->executeTick();
      if (result == NodeStatus::RUNNING) return result;
      resetChild();
      if (result == NodeStatus::SKIPPED) return result;
      if (result != lockstep_goes_on_) return lockstep_end(result);
      ++lockstep_count_;
      lockstep_read_most();
      if (begins && (lockstep_count_ < lockstep_most_ || lockstep_most_ == -1)) {
        emitWakeUpSignal();
        return NodeStatus::RUNNING;
      }
    }
    return lockstep_end(lockstep_goes_on_);
  }

 private:
  void lockstep_read_most() {
    if (lockstep_port_ == nullptr) return;
    const auto most = getInput<int>(lockstep_port_);
    if (!most) throw RuntimeError("node '", name(), "': ", most.error());
    lockstep_most_ = *most;
  }
  NodeStatus lockstep_end(NodeStatus result) {
    lockstep_count_ = 0;
    return result;
  }

  NodeStatus lockstep_goes_on_;
  const char* lockstep_port_ = nullptr;  // null: the count was given to the constructor
  int lockstep_most_ = 0, lockstep_count_ = 0;
};

}  // namespace BT::lockstep_detail
