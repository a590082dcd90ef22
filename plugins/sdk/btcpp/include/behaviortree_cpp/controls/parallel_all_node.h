// As the tag ParallelAll.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "behaviortree_cpp/control_node.h"
#include "behaviortree_cpp/lockstep/counts.h"
#include "behaviortree_cpp/lockstep/parameter.h"

namespace BT {

class ParallelAllNode : public ControlNode {
 public:
  ParallelAllNode(const std::string& name, const NodeConfig& config) : ControlNode(name, config) {
    setRegistrationID("ParallelAll");
  }
  static PortsList providedPorts() {
    return {InputPort<int>("max_failures", 1,
                           "from how many failures on it fails; -1: all, -2: all but one, and so "
                           "on")};
  }

  // In numbers of children; each tick reads it from the port.
  std::size_t failureThreshold() const {
    return lockstep_detail::count_of(lockstep_most_, childrenCount());
  }
  void setFailureThreshold(int threshold) { lockstep_most_ = threshold; }

  void halt() override {
    lockstep_results_.clear();
    ControlNode::halt();
  }

 protected:
  NodeStatus tick() override {
    lockstep_most_ = lockstep_detail::parameter<int>(*this, "max_failures");
    if (childrenCount() < failureThreshold()) {
      lockstep_refuse_children(", and fails with " + std::to_string(failureThreshold()) +
                               " of them");
    }
    if (status() != NodeStatus::RUNNING) lockstep_results_.clear();
    lockstep_results_.resize(childrenCount(), NodeStatus::IDLE);
    setStatus(NodeStatus::RUNNING);
    std::size_t skipped = 0, completed = 0;
    for (std::size_t i = 0; i < childrenCount(); ++i) {
      if (lockstep_results_[i] == NodeStatus::IDLE) {
        const NodeStatus result = children_nodes_[i]->executeTick();
        if (isStatusCompleted(result)) lockstep_results_[i] = result;
        if (result == NodeStatus::SKIPPED) ++skipped;
      }
      if (lockstep_results_[i] != NodeStatus::IDLE) ++completed;
    }
    if (skipped == childrenCount()) return NodeStatus::SKIPPED;
    return completed + skipped < childrenCount() ? NodeStatus::RUNNING : lockstep_end();
  }

 private:
  NodeStatus lockstep_end() {
    const auto failed =
        std::count(lockstep_results_.begin(), lockstep_results_.end(), NodeStatus::FAILURE);
    lockstep_results_.clear();
    resetChildren();
    return static_cast<std::size_t>(failed) >= failureThreshold() ? NodeStatus::FAILURE
                                                                  : NodeStatus::SUCCESS;
  }

  int lockstep_most_ = 1;
  std::vector<NodeStatus> lockstep_results_;  // of this activation; IDLE: not completed
};

}  // namespace BT
