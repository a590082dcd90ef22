// As the tag Parallel.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "behaviortree_cpp/control_node.h"
#include "behaviortree_cpp/lockstep/counts.h"
#include "behaviortree_cpp/lockstep/parameter.h"

namespace BT {

class ParallelNode : public ControlNode {
 public:
  // By hand, the thresholds are set by the functions below.
  explicit ParallelNode(const std::string& name) : ControlNode(name, {}) {
    setRegistrationID("Parallel");
  }
  ParallelNode(const std::string& name, const NodeConfig& config)
      : ControlNode(name, config), lockstep_reads_ports_(true) {
    setRegistrationID("Parallel");
  }
  static PortsList providedPorts() {
    return {InputPort<int>("success_count", -1,
                           "how many children must succeed; -1: all, -2: all but one, and so on"),
            InputPort<int>("failure_count", 1,
                           "how many children must fail; -1: all, -2: all but one, and so on")};
  }

  // In numbers of children.
  std::size_t successThreshold() const {
    return lockstep_detail::count_of(lockstep_wanted_, childrenCount());
  }
  std::size_t failureThreshold() const {
    return lockstep_detail::count_of(lockstep_most_, childrenCount());
  }
  void setSuccessThreshold(int threshold) { lockstep_wanted_ = threshold; }
  void setFailureThreshold(int threshold) { lockstep_most_ = threshold; }

  void halt() override {
    lockstep_forget();
    ControlNode::halt();
  }

 protected:
  NodeStatus tick() override {
    lockstep_begin();
    setStatus(NodeStatus::RUNNING);
    std::size_t skipped = 0;
    for (std::size_t i = 0; i < childrenCount(); ++i) {
      if (lockstep_results_[i] == NodeStatus::IDLE) {
        const NodeStatus result = children_nodes_[i]->executeTick();
        if (isStatusCompleted(result)) lockstep_results_[i] = result;
        if (result == NodeStatus::SKIPPED) ++skipped;
      }
      const NodeStatus decided = lockstep_decide(skipped);
      if (isStatusCompleted(decided)) return lockstep_end(decided);
    }
    return skipped == childrenCount() ? NodeStatus::SKIPPED : NodeStatus::RUNNING;
  }

 private:
  void lockstep_begin() {
    if (lockstep_reads_ports_) {
      lockstep_wanted_ = lockstep_detail::parameter<int>(*this, "success_count");
      lockstep_most_ = lockstep_detail::parameter<int>(*this, "failure_count");
    }
    if (childrenCount() < successThreshold() || childrenCount() < failureThreshold()) {
      lockstep_refuse_children(", and wants a success of " + std::to_string(successThreshold()) +
                               " or a failure of " + std::to_string(failureThreshold()) +
                               " of them");
    }
    if (status() != NodeStatus::RUNNING) lockstep_forget();
    lockstep_results_.resize(childrenCount(), NodeStatus::IDLE);
  }
  // After each child, so that those to the right of the one that decides are not ticked.
  NodeStatus lockstep_decide(std::size_t skipped) const {
    const std::size_t wanted = successThreshold();
    const std::size_t failed = lockstep_count(NodeStatus::FAILURE);
    const std::size_t counted =
        lockstep_count(NodeStatus::SUCCESS) + (lockstep_wanted_ < 0 ? skipped : 0);
    if (counted >= wanted) return NodeStatus::SUCCESS;
    const bool is_lost = childrenCount() - failed < wanted || failed == failureThreshold();
    return is_lost ? NodeStatus::FAILURE : NodeStatus::RUNNING;
  }
  std::size_t lockstep_count(NodeStatus result) const {
    return static_cast<std::size_t>(
        std::count(lockstep_results_.begin(), lockstep_results_.end(), result));
  }
  NodeStatus lockstep_end(NodeStatus result) {
    lockstep_forget();
    resetChildren();
    return result;
  }
  void lockstep_forget() { lockstep_results_.clear(); }

  int lockstep_wanted_ = -1, lockstep_most_ = 1;
  bool lockstep_reads_ports_ = false;
  std::vector<NodeStatus> lockstep_results_;  // of this activation; IDLE: not completed
};

}  // namespace BT
