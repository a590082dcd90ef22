// A child that is ticked again and again: what RepeatNode and RetryNode share.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"
#include "behaviortree_cpp/lockstep/parameter.h"

namespace BT::lockstep_detail {

// As often as its port says, -1 for ever, as long as the child returns `goes_on`.
class LockstepAgainNode : public DecoratorNode {
 public:
  LockstepAgainNode(const std::string& name, const NodeConfig& config, NodeStatus goes_on,
                    const char* id, const char* port)
      : DecoratorNode(name, config), lockstep_goes_on_(goes_on), lockstep_port_(port) {
    setRegistrationID(id);
  }
  LockstepAgainNode(const std::string& name, int most, NodeStatus goes_on, const char* id)
      : DecoratorNode(name, {}), lockstep_goes_on_(goes_on), lockstep_most_(most) {
    setRegistrationID(id);
  }

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
      const NodeStatus result = lockstep_tick_child();
      if (result == NodeStatus::RUNNING) return result;
      resetChild();
      if (result == NodeStatus::SKIPPED) return result;
      if (result != lockstep_goes_on_) return lockstep_end(result);
      ++lockstep_count_;
      lockstep_read_most();
      if (begins && requiresWakeUp() &&
          (lockstep_count_ < lockstep_most_ || lockstep_most_ == -1)) {
        emitWakeUpSignal();
        return NodeStatus::RUNNING;
      }
    }
    return lockstep_end(lockstep_goes_on_);
  }

 private:
  void lockstep_read_most() {
    if (lockstep_port_ == nullptr) return;
    lockstep_most_ = parameter<int>(*this, lockstep_port_);
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
