#include <behaviortree_cpp/bt_factory.h>

#include <iostream>

class Greet : public BT::SyncActionNode {
 public:
  Greet(const std::string& name, const BT::NodeConfig& config) : BT::SyncActionNode(name, config) {}
  static BT::PortsList providedPorts() {
    return {BT::InputPort<std::string>("whom", "world", "who")};
  }

  BT::NodeStatus tick() override {
    std::cout << "hello, " << getInput<std::string>("whom").value() << std::endl;
    return BT::NodeStatus::SUCCESS;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Greet>("Greet");
}
