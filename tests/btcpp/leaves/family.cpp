// Control nodes and decorators of users.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

// Ticks its children in turn, one of them in each tick.
class InTurn : public ControlNode {
 public:
  InTurn(const std::string& name, const NodeConfig& config) : ControlNode(name, config) {}
  static PortsList providedPorts() { return {}; }

  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    while (current_ < childrenCount()) {
      TreeNode* child = children_nodes_[current_];
      const NodeStatus before = child->status();
      const NodeStatus result = child->executeTick();
      std::cout << name() << ": " << child->name() << " (" << child->registrationName() << ") "
                << before << " -> " << result << " " << child->status() << std::endl;
      if (result == NodeStatus::RUNNING) return result;
      if (result == NodeStatus::FAILURE) {
        resetChildren();
        current_ = 0;
        return result;
      }
      ++current_;
    }
    haltChildren();
    for (const auto* child : children()) std::cout << child->status() << " ";
    std::cout << std::endl;
    current_ = 0;
    return NodeStatus::SUCCESS;
  }
  void halt() override {
    if (status() == NodeStatus::RUNNING) std::cout << name() << " halts" << std::endl;
    current_ = 0;
    ControlNode::halt();
  }

 private:
  std::size_t current_ = 0;
};

// Lets the first child run until the second succeeds; asks the second in every tick.
class Until : public ControlNode {
 public:
  Until(const std::string& name, const NodeConfig& config) : ControlNode(name, config) {}
  static PortsList providedPorts() { return {}; }

  NodeStatus tick() override {
    if (childrenCount() != 2) throw LogicError("Until has two children");
    children_nodes_[0]->executeTick();
    if (children_nodes_[1]->executeTick() != NodeStatus::SUCCESS) return NodeStatus::RUNNING;
    std::cout << "until: " << children_nodes_[0]->status() << std::endl;
    haltChild(0);
    std::cout << "until: " << children_nodes_[0]->status() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Again : public DecoratorNode {
 public:
  Again(const std::string& name, const NodeConfig& config) : DecoratorNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("times")}; }

  NodeStatus tick() override {
    const int times = getInput<int>("times").value();
    setStatus(NodeStatus::RUNNING);
    // Several times in one tick.
    while (done_ < times) {
      const NodeStatus result = child_node_->executeTick();
      std::cout << name() << " " << done_ << " " << result << std::endl;
      if (result == NodeStatus::RUNNING) return result;
      resetChild();
      ++done_;
    }
    done_ = 0;
    return NodeStatus::SUCCESS;
  }
  void halt() override {
    if (status() == NodeStatus::RUNNING)
      std::cout << name() << " halts at " << done_ << ", child " << child()->status() << std::endl;
    done_ = 0;
    DecoratorNode::halt();
  }

 private:
  int done_ = 0;
};

class Shy : public DecoratorNode {
 public:
  Shy(const std::string& name, const NodeConfig& config) : DecoratorNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    const NodeStatus before = child_node_->status();
    const NodeStatus result = child_node_->executeTick();
    std::cout << name() << " " << before << " " << result << " " << child_node_->name()
              << std::endl;
    return result == NodeStatus::FAILURE ? NodeStatus::SUCCESS : result;
  }
};

class Work : public StatefulActionNode {
 public:
  Work(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("ticks")}; }
  NodeStatus onStart() override {
    left_ = getInput<int>("ticks").value();
    return onRunning();
  }
  NodeStatus onRunning() override {
    return left_-- > 0 ? NodeStatus::RUNNING : NodeStatus::SUCCESS;
  }
  void onHalted() override { std::cout << name() << " halted" << std::endl; }

 private:
  int left_ = 0;
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<InTurn>("InTurn");
  factory.registerNodeType<Until>("Until");
  factory.registerNodeType<Again>("Again");
  factory.registerNodeType<Shy>("Shy");
  factory.registerNodeType<Work>("Work");
  factory.registerSimpleDecorator("Opposite", [](NodeStatus status, TreeNode& node) {
    std::cout << "opposite of " << status << " " << node.name() << std::endl;
    return status == NodeStatus::SUCCESS ? NodeStatus::FAILURE : NodeStatus::SUCCESS;
  });
}
