// Ticks its child for each item of a queue, as many as complete at once in one tick.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "behaviortree_cpp/actions/pop_from_queue.hpp"
#include "behaviortree_cpp/decorator_node.h"

namespace BT {

template <class T>
class [[deprecated("use LoopNode")]] ConsumeQueue : public DecoratorNode {
 public:
  ConsumeQueue(const std::string& name, const NodeConfig& config) : DecoratorNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<std::shared_ptr<ProtectedQueue<T>>>("queue"), OutputPort<T>("popped_item")};
  }

  NodeStatus tick() override {
    NodeStatus result = NodeStatus::SUCCESS;
    if (lockstep_is_child_running_) {
      result = lockstep_go_on();
      if (lockstep_is_child_running_) return result;
    }
    while (const auto item = lockstep_next()) {
      setStatus(NodeStatus::RUNNING);
      setOutput("popped_item", *item);
      result = lockstep_go_on();
      if (lockstep_is_child_running_ || result == NodeStatus::FAILURE) return result;
    }
    return result;
  }

 private:
  NodeStatus lockstep_go_on() {
    const NodeStatus result = this->lockstep_tick_child();
    lockstep_is_child_running_ = result == NodeStatus::RUNNING;
    if (!lockstep_is_child_running_) haltChild();
    return result;
  }
  std::optional<T> lockstep_next() {
    std::shared_ptr<ProtectedQueue<T>> queue;
    if (!getInput("queue", queue) || queue == nullptr) return std::nullopt;
    const std::unique_lock<std::mutex> lock(queue->mtx);
    if (queue->items.empty()) return std::nullopt;
    std::optional<T> item(queue->items.front());
    queue->items.pop_front();
    return item;
  }

  bool lockstep_is_child_running_ = false;
};

}  // namespace BT
