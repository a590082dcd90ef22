// What nodes do wrong, and what only lockstep asks of them.
#include <iostream>
#include <limits>
#include <string>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

class Wrong : public SyncActionNode {
 public:
  Wrong(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {
    if (getInput<std::string>("how").value() == "throws in its constructor") {
      throw RuntimeError("no ", "device");
    }
  }
  static PortsList providedPorts() {
    return {InputPort<std::string>("how"), InputPort<int>("number")};
  }

  NodeStatus tick() override {
    const auto how = getInput<std::string>("how").value();
    if (how == "throws") throw LogicError("it is ", std::string("broken"));
    if (how == "throws 42") throw 42;
    if (how == "runs") return NodeStatus::RUNNING;
    if (how == "is idle") return NodeStatus::IDLE;
    if (how == "reads nothing") getInput<int>("number").value();
    if (how == "reads no port") getInput<int>("speed").value();
    if (how == "writes an input") setOutput("number", 5).value();
    return NodeStatus::SUCCESS;
  }
};

// A class that knows why it fails.
class Blind : public SyncActionNode {
 public:
  Blind(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override { return NodeStatus::FAILURE; }
  std::string reason() const { return "the lens is covered"; }
};

// A sensor without a reading: it gives NaN, and shows what is there.
class Lost : public SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() {
    return {InputPort<double>("seen"), OutputPort<double>("value")};
  }
  NodeStatus tick() override {
    if (const auto seen = getInput<double>("seen")) std::cout << *seen << std::endl;
    setOutput("value", std::numeric_limits<double>::quiet_NaN()).value();
    return NodeStatus::SUCCESS;
  }
};

// The class that serves both: with progress, and held at barriers.
class Reach : public StatefulActionNode {
 public:
  Reach(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<double>("step", 0.1, "per tick")}; }

  NodeStatus onStart() override {
    at_ = 0;
    return onRunning();
  }
  NodeStatus onRunning() override {
    at_ += getInput<double>("step").value();
    return at_ >= 1 ? NodeStatus::SUCCESS : NodeStatus::RUNNING;
  }
  void onHalted() override {}

  double progress() const { return at_; }
  void onPaused() { std::cout << name() << " holds at " << at_ << std::endl; }
  double onPace(double factor) { return factor; }
  void onResumed() { std::cout << name() << " goes on" << std::endl; }
  std::string onSave() const { return std::to_string(at_); }
  bool onRestored(const std::string& kept) {
    at_ = std::stod(kept);
    return true;
  }

 private:
  double at_ = 0;
};

// Names that lockstep's own language has for its nodes, and such as only XML allows.
class Wait : public SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() { return {InputPort<int>("wait-time")}; }
  NodeStatus tick() override {
    std::cout << registrationName() << " " << getInput<int>("wait-time").value() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Wrong>("Wrong");
  factory.registerNodeType<Blind>("Blind");
  factory.registerNodeType<Lost>("Lost");
  factory.registerNodeType<Reach>("Reach");
  factory.registerNodeType<Wait>("Wait");
  factory.registerNodeType<Wait>("Wärmen-bis");
}
