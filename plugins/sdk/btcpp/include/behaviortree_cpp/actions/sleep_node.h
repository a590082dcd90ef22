// As the tag Sleep.
#pragma once

#include <string>

#include "behaviortree_cpp/action_node.h"
#include "behaviortree_cpp/lockstep/parameter.h"
#include "behaviortree_cpp/lockstep/wait.h"

namespace BT {

class SleepNode : public StatefulActionNode {
 public:
  SleepNode(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {
    setRegistrationID("Sleep");
  }
  static PortsList providedPorts() { return {InputPort<unsigned>("msec", "how long to sleep")}; }

  NodeStatus onStart() override {
    lockstep_milliseconds_ = lockstep_detail::parameter<unsigned>(*this, "msec");
    lockstep_wait_.forget();
    return onRunning();
  }
  NodeStatus onRunning() override {
    const bool is_over = lockstep_wait_.is_over(lockstep_seconds(), lockstep_milliseconds_);
    return is_over ? NodeStatus::SUCCESS : NodeStatus::RUNNING;
  }
  void onHalted() override {}

 private:
  unsigned lockstep_milliseconds_ = 0;
  lockstep_detail::Wait lockstep_wait_;
};

}  // namespace BT
