// Takes an item from a queue, or counts them. To be registered for each type of items:
// factory.registerNodeType<BT::PopFromQueue<Pose>>("PopPose").
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "behaviortree_cpp/action_node.h"
#include "behaviortree_cpp/lockstep/queue.h"

namespace BT {
namespace lockstep_detail {

// Fails when the port has no queue, or an empty one.
template <class T>
class LockstepQueueAction : public SyncActionNode {
 public:
  using LockstepQueue = std::shared_ptr<ProtectedQueue<T>>;
  using SyncActionNode::SyncActionNode;

  NodeStatus tick() override {
    LockstepQueue queue;
    if (!getInput("queue", queue) || queue == nullptr) return NodeStatus::FAILURE;
    const std::unique_lock<std::mutex> lock(queue->mtx);
    if (queue->items.empty()) return NodeStatus::FAILURE;
    lockstep_use(*queue);
    return NodeStatus::SUCCESS;
  }

 private:
  virtual void lockstep_use(ProtectedQueue<T>& queue) = 0;
};

}  // namespace lockstep_detail

template <class T>
class PopFromQueue : public lockstep_detail::LockstepQueueAction<T> {
 public:
  PopFromQueue(const std::string& name, const NodeConfig& config)
      : lockstep_detail::LockstepQueueAction<T>(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<std::shared_ptr<ProtectedQueue<T>>>("queue"), OutputPort<T>("popped_item")};
  }

 private:
  void lockstep_use(ProtectedQueue<T>& queue) override {
    const T item = queue.items.front();
    queue.items.pop_front();
    this->setOutput("popped_item", item);
  }
};

template <class T>
class QueueSize : public lockstep_detail::LockstepQueueAction<T> {
 public:
  QueueSize(const std::string& name, const NodeConfig& config)
      : lockstep_detail::LockstepQueueAction<T>(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<std::shared_ptr<ProtectedQueue<T>>>("queue"), OutputPort<int>("size")};
  }

 private:
  void lockstep_use(ProtectedQueue<T>& queue) override {
    this->setOutput("size", static_cast<int>(queue.items.size()));
  }
};

}  // namespace BT
