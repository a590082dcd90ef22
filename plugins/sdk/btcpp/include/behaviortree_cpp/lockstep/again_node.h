// A child that is ticked again and again: what RepeatNode and RetryNode share.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT::detail {

// As often as its port says, -1 for ever, as long as the child returns `goes_on`.
class AgainNode : public DecoratorNode {
 public:
  AgainNode(const std::string& name, const NodeConfig& config, NodeStatus goes_on, const char* port)
      : DecoratorNode(name, config), goes_on_(goes_on), port_(port) {}
  AgainNode(const std::string& name, int most, NodeStatus goes_on)
      : DecoratorNode(name, {}), goes_on_(goes_on), most_(most) {}

  void halt() override {
    count_ = 0;
    DecoratorNode::halt();
  }

 protected:
  NodeStatus tick() override {
    read_most();
    setStatus(NodeStatus::RUNNING);
    while (count_ < most_ || most_ == -1) {
      const bool begins = child_node_->status() == NodeStatus::IDLE;
      const NodeStatus result = child_node_->executeTick();
      if (result == NodeStatus::RUNNING) return result;
      resetChild();
      if (result == NodeStatus::SKIPPED) return result;
      if (result != goes_on_) return end(result);
      ++count_;
      read_most();
      if (begins && (count_ < most_ || most_ == -1)) {
        emitWakeUpSignal();
        return NodeStatus::RUNNING;
      }
    }
    return end(goes_on_);
  }

 private:
  void read_most() {
    if (port_ == nullptr) return;
    const auto most = getInput<int>(port_);
    if (!most) throw RuntimeError("node '", name(), "': ", most.error());
    most_ = *most;
  }
  NodeStatus end(NodeStatus result) {
    count_ = 0;
    return result;
  }

  NodeStatus goes_on_;
  const char* port_ = nullptr;  // null: the count was given to the constructor
  int most_ = 0, count_ = 0;
};

}  // namespace BT::detail
