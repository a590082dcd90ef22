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
    if (status() == NodeStatus::IDLE) {
      is_child_running_ = false;
      items_ = nullptr;
    }
    if (!is_child_running_) {
      find_items();
      if (items_ == nullptr || items_->empty()) return getInput<NodeStatus>("if_empty").value();
      const T item = std::move(items_->front());
      items_->pop_front();
      setOutput("value", item);
    }
    setStatus(NodeStatus::RUNNING);
    const NodeStatus result = child_node_->executeTick();
    is_child_running_ = result == NodeStatus::RUNNING;
    if (isStatusCompleted(result)) resetChild();
    return result == NodeStatus::FAILURE ? result : NodeStatus::RUNNING;
  }

 private:
  // An entry with a queue is taken from. A list, or a text, is copied in each activation.
  void find_items() {
    if (auto queue = getInput<SharedQueue<T>>("queue"); queue && !is_text()) {
      items_ = std::move(*queue);
    } else if (items_ != nullptr) {
      return;
    } else if (queue) {
      items_ = std::move(*queue);
    } else if (const auto list = getInput<std::vector<T>>("queue")) {
      items_ = std::make_shared<std::deque<T>>(list->begin(), list->end());
    } else {
      throw RuntimeError("LoopNode: port 'queue': ", queue.error());
    }
  }
  bool is_text() const {
    const auto value = getInput<Any>("queue");
    return value && value->isString();
  }

  SharedQueue<T> items_;
  bool is_child_running_ = false;
};

}  // namespace BT
