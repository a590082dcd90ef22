// As the tags SkipUnlessUpdated and WaitValueUpdate, which differ in `if_not_updated`.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"
#include "behaviortree_cpp/lockstep/seen_entry.h"

namespace BT {

class EntryUpdatedDecorator : public DecoratorNode {
 public:
  using LockstepOpens = void;  // uses entries by their names
  EntryUpdatedDecorator(const std::string& name, const NodeConfig& config,
                        NodeStatus if_not_updated)
      : DecoratorNode(name, config), lockstep_entry_(config), lockstep_otherwise_(if_not_updated) {
    setRegistrationID(if_not_updated == NodeStatus::RUNNING ? "WaitValueUpdate"
                                                            : "SkipUnlessUpdated");
  }
  static PortsList providedPorts() { return {InputPort<Any>("entry", "the entry to look at")}; }

  void halt() override {
    lockstep_child_runs_ = false;
    DecoratorNode::halt();
  }

 protected:
  NodeStatus tick() override {
    if (!lockstep_child_runs_ && !lockstep_entry_.is_written(config())) return lockstep_otherwise_;
    const NodeStatus result = lockstep_tick_child();
    lockstep_child_runs_ = result == NodeStatus::RUNNING;
    return result;
  }

 private:
  lockstep_detail::SeenEntry lockstep_entry_;
  NodeStatus lockstep_otherwise_;
  bool lockstep_child_runs_ = false;
};

}  // namespace BT
