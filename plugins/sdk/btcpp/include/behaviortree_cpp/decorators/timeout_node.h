// As the tag Timeout: a child that runs when the time is over is halted in the next tick. No thread
// halts it between two ticks, as the library's does.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"
#include "behaviortree_cpp/lockstep/parameter.h"
#include "behaviortree_cpp/lockstep/wait.h"

namespace BT {

class TimeoutNode : public DecoratorNode {
 public:
  TimeoutNode(const std::string& name, unsigned milliseconds)
      : DecoratorNode(name, {}), lockstep_milliseconds_(milliseconds) {
    setRegistrationID("Timeout");
  }
  TimeoutNode(const std::string& name, const NodeConfig& config)
      : DecoratorNode(name, config), lockstep_reads_port_(true) {
    setRegistrationID("Timeout");
  }
  static PortsList providedPorts() {
    return {InputPort<unsigned>("msec", "how long the child may run; 0: for ever")};
  }

  void halt() override {
    lockstep_forget();
    DecoratorNode::halt();
  }

 protected:
  NodeStatus tick() override {
    if (lockstep_reads_port_) {
      lockstep_milliseconds_ = lockstep_detail::parameter<unsigned>(*this, "msec");
    }
    setStatus(NodeStatus::RUNNING);
    if (lockstep_is_due() && lockstep_child_runs_) {
      lockstep_forget();
      resetChild();
      return NodeStatus::FAILURE;
    }
    const NodeStatus result = lockstep_tick_child();
    lockstep_child_runs_ = result == NodeStatus::RUNNING;
    if (isStatusCompleted(result)) {
      lockstep_forget();
      resetChild();
    }
    return result;
  }

 private:
  // Once: a child that begins after that runs as long as it likes.
  bool lockstep_is_due() {
    const bool is_over = lockstep_wait_.is_over(lockstep_seconds(), lockstep_milliseconds_);
    if (lockstep_was_over_ || lockstep_milliseconds_ == 0 || !is_over) return false;
    lockstep_was_over_ = true;
    return true;
  }
  void lockstep_forget() {
    lockstep_wait_.forget();
    lockstep_was_over_ = lockstep_child_runs_ = false;
  }

  unsigned lockstep_milliseconds_ = 0;
  bool lockstep_reads_port_ = false, lockstep_was_over_ = false;
  bool lockstep_child_runs_ = false;  // after its last tick
  lockstep_detail::Wait lockstep_wait_;
};

}  // namespace BT
