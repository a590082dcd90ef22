// The library's nodes as classes under other IDs: they do what their tags do.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

class Say : public SyncActionNode {
 public:
  Say(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    std::cout << name() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Wait : public StatefulActionNode {
 public:
  Wait(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus onStart() override {
    std::cout << name() << " begins" << std::endl;
    return NodeStatus::RUNNING;
  }
  NodeStatus onRunning() override { return NodeStatus::RUNNING; }
  void onHalted() override { std::cout << name() << " halted" << std::endl; }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Say>("Say");
  factory.registerNodeType<Wait>("Wait");
  factory.registerNodeType<ParallelNode>("Side");
  factory.registerNodeType<ParallelAllNode>("Every");
  factory.registerNodeType<IfThenElseNode>("If");
  factory.registerNodeType<WhileDoElseNode>("While");
  factory.registerNodeType<SwitchNode<2>>("Choice");
  factory.registerNodeType<TryCatchNode>("Try");
  factory.registerNodeType<DelayNode>("Late");
  factory.registerNodeType<TimeoutNode>("Soon");
  factory.registerNodeType<SleepNode>("Nap");
  factory.registerNodeType<SetBlackboardNode>("Put");
  factory.registerNodeType<UnsetBlackboardNode>("Remove");
}
