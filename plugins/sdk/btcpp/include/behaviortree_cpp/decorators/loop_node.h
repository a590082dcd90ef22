// Ticks its child once for each item of a queue:
// factory.registerNodeType<BT::LoopNode<Pose>>("LoopPose").
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "behaviortree_cpp/decorator_node.h"
#include "behaviortree_cpp/lockstep/queue.h"

namespace BT {

template <class T = Any>
class LoopNode : public DecoratorNode {
 public:
  LoopNode(const std::string& name, const NodeConfig& config) : DecoratorNode(name, config) {}

  static PortsList providedPorts() {
    return {BidirectionalPort("queue"),
            InputPort<NodeStatus>("if_empty", NodeStatus::SUCCESS,
                                  "the result when no item is left: SUCCESS, FAILURE or SKIPPED"),
            OutputPort<T>("value")};
  }

  NodeStatus tick() override {
    if (status() != NodeStatus::RUNNING) {
      lockstep_is_child_running_ = false;
      lockstep_items_ = nullptr;
    }
    if (!lockstep_is_child_running_) {
      lockstep_find_items();
      if (lockstep_items_ == nullptr || lockstep_items_->empty())
        return getInput<NodeStatus>("if_empty").value();
      const T item = std::move(lockstep_items_->front());
      lockstep_items_->pop_front();
      setOutput("value", item);
    }
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = lockstep_tick_child();
    lockstep_is_child_running_ = result == NodeStatus::RUNNING;
    if (isStatusCompleted(result)) resetChild();
    return result == NodeStatus::FAILURE ? result : NodeStatus::RUNNING;
  }

 private:
  // An entry with a queue is taken from. A list, or a text, is copied in each activation.
  void lockstep_find_items() {
    auto queue = getInput<SharedQueue<T>>("queue");
    const bool is_taken_from = queue && !lockstep_is_text();
    if (lockstep_items_ != nullptr && !is_taken_from) return;
    if (queue) {
      lockstep_items_ = std::move(*queue);
    } else if (const auto list = getInput<std::vector<T>>("queue")) {
      lockstep_items_ = std::make_shared<std::deque<T>>(list->begin(), list->end());
    } else {
      throw RuntimeError("LoopNode: port 'queue': ", queue.error());
    }
  }
  bool lockstep_is_text() const {
    const auto value = getInput<Any>("queue");
    return value && value->isString();
  }

  SharedQueue<T> lockstep_items_;
  bool lockstep_is_child_running_ = false;
};

}  // namespace BT
