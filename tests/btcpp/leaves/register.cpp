// All ways to register a node.
#include <iostream>
#include <memory>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

struct Robot {
  std::string name = "r2";
  int moves = 0;
};

class WithArguments : public SyncActionNode {
 public:
  WithArguments(const std::string& name, const NodeConfig& config, int number, std::string text,
                std::shared_ptr<Robot> robot)
      : SyncActionNode(name, config),
        number_(number),
        text_(std::move(text)),
        robot_(std::move(robot)) {}
  static PortsList providedPorts() { return {}; }
  static KeyValueVector metadata() { return {{"description", "shows its arguments"}}; }

  NodeStatus tick() override {
    std::cout << registrationName() << " " << number_ << " " << text_ << " " << robot_->name << " "
              << ++robot_->moves << std::endl;
    return NodeStatus::SUCCESS;
  }

 private:
  int number_;
  std::string text_;
  std::shared_ptr<Robot> robot_;
};

class OnlyName : public ConditionNode {
 public:
  explicit OnlyName(const std::string& name) : ConditionNode(name, {}) {}
  NodeStatus tick() override {
    std::cout << "only " << name() << " " << registrationName() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Base : public SyncActionNode {
 public:
  Base(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList basicPorts(PortsList more) {
    PortsList ports = {InputPort<std::string>("common", "shared", "of all")};
    ports.insert(more.begin(), more.end());
    return ports;
  }
  static PortsList providedPorts() { return basicPorts({}); }
  NodeStatus tick() override {
    std::cout << getInput<std::string>("common").value() << " " << detail() << std::endl;
    return NodeStatus::SUCCESS;
  }
  virtual std::string detail() { return "base"; }
};

class Derived : public Base {
 public:
  using Base::Base;
  static PortsList providedPorts() { return basicPorts({InputPort<int>("own", 5, "its own")}); }
  std::string detail() override { return std::to_string(getInput<int>("own").value()); }
};

template <int kNumber>
class Numbered : public SyncActionNode {
 public:
  Numbered(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    std::cout << "number " << kNumber << std::endl;
    return NodeStatus::SUCCESS;
  }
};

BT_REGISTER_NODES(factory) {
  static const auto robot = std::make_shared<Robot>();

  factory.registerNodeType<WithArguments>("WithArguments", 42, std::string("text"), robot);
  factory.registerNodeType<WithArguments>("OtherArguments", 7, "literal", robot);
  factory.registerNodeType<OnlyName>("OnlyName");
  factory.registerNodeType<Base>("Base");
  factory.registerNodeType<Derived>("Derived");
  factory.registerNodeType<Numbered<1>>("One");
  factory.registerNodeType<Numbered<2>>("Two");

  NodeBuilder builder = [](const std::string& name, const NodeConfig& config) {
    return std::make_unique<WithArguments>(name, config, 3, "built", robot);
  };
  factory.registerBuilder<WithArguments>("Built", builder);
  factory.registerBuilder(CreateManifest<WithArguments>("BuiltToo"), builder);

  factory.registerSimpleAction("Count",
                               [](TreeNode& node) {
                                 const int step = node.getInput<int>("step").value();
                                 robot->moves += step;
                                 std::cout << node.name() << " " << robot->moves << std::endl;
                                 node.setOutput("count", robot->moves);
                                 return NodeStatus::SUCCESS;
                               },
                               {InputPort<int>("step"), OutputPort<int>("count")});
  factory.registerSimpleCondition(
      "Enough",
      [](TreeNode& node) {
        return node.getInput<int>("count").value() > 5 ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
      },
      {InputPort<int>("count")});
}
