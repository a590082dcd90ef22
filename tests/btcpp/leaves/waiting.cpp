// Work in a thread, and work that gives the control back in its middle.
#include <chrono>
#include <iostream>
#include <thread>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

class Sum : public ThreadedAction {
 public:
  Sum(const std::string& name, const NodeConfig& config) : ThreadedAction(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<int>("a"), InputPort<std::string>("b"), OutputPort<int>("sum")};
  }

  NodeStatus tick() override {
    const int sum = getInput<int>("a").value() + getInput<int>("b").value();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    setOutput("sum", sum);
    return sum > 5 ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }
};

class Endless : public ThreadedAction {
 public:
  Endless(const std::string& name, const NodeConfig& config) : ThreadedAction(name, config) {}
  static PortsList providedPorts() { return {}; }

  NodeStatus tick() override {
    for (int i = 0; i < 5000 && !isHaltRequested(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return NodeStatus::SUCCESS;
  }
  void halt() override {
    if (status() == NodeStatus::RUNNING) std::cout << name() << " is halted" << std::endl;
    ThreadedAction::halt();
  }
};

class Steps : public CoroActionNode {
 public:
  Steps(const std::string& name, const NodeConfig& config) : CoroActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("steps"), OutputPort<int>("at")}; }

  NodeStatus tick() override {
    const int steps = getInput<int>("steps").value();
    for (int i = 0; i < steps; ++i) {
      std::cout << name() << " " << i << " " << status() << std::endl;
      setOutput("at", i);
      setStatusRunningAndYield();
    }
    std::cout << name() << " ends" << std::endl;
    return steps % 2 == 0 ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }
  void halt() override {
    if (status() == NodeStatus::RUNNING) std::cout << name() << " is halted" << std::endl;
    CoroActionNode::halt();
  }
};

class Show : public SyncActionNode {
 public:
  Show(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("value")}; }
  NodeStatus tick() override {
    std::cout << getInput<int>("value").value() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Sum>("Sum");
  factory.registerNodeType<Endless>("Endless");
  factory.registerNodeType<Steps>("Steps");
  factory.registerNodeType<Show>("Show");
}
