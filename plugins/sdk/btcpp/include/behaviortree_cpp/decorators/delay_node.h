// As the tag Delay.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"
#include "behaviortree_cpp/lockstep/parameter.h"
#include "behaviortree_cpp/lockstep/wait.h"

namespace BT {

class DelayNode : public DecoratorNode {
 public:
  DelayNode(const std::string& name, unsigned milliseconds)
      : DecoratorNode(name, {}), lockstep_milliseconds_(milliseconds) {
    setRegistrationID("Delay");
  }
  DelayNode(const std::string& name, const NodeConfig& config)
      : DecoratorNode(name, config), lockstep_reads_port_(true) {
    setRegistrationID("Delay");
  }
  static PortsList providedPorts() {
    return {InputPort<unsigned>("delay_msec", "how long to wait before the child is ticked")};
  }

  void halt() override {
    lockstep_forget();
    DecoratorNode::halt();
  }

 protected:
  NodeStatus tick() override {
    if (lockstep_reads_port_) {
      lockstep_milliseconds_ = lockstep_detail::parameter<unsigned>(*this, "delay_msec");
    }
    setStatus(NodeStatus::RUNNING);
    if (!lockstep_is_over_) {
      lockstep_is_over_ = lockstep_wait_.is_over(lockstep_seconds(), lockstep_milliseconds_);
      if (!lockstep_is_over_) return NodeStatus::RUNNING;
    }
    const NodeStatus result = lockstep_tick_child();
    if (isStatusCompleted(result)) {
      lockstep_forget();
      resetChild();
    }
    return result;
  }

 private:
  void lockstep_forget() {
    lockstep_wait_.forget();
    lockstep_is_over_ = false;
  }

  unsigned lockstep_milliseconds_ = 0;
  bool lockstep_reads_port_ = false, lockstep_is_over_ = false;
  lockstep_detail::Wait lockstep_wait_;
};

}  // namespace BT
