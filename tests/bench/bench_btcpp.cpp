// The cheapest nodes that are written for BehaviorTree.CPP: what the headers for them cost.
#include "behaviortree_cpp/bt_factory.h"

namespace {

class BtSuccess : public BT::SyncActionNode {
 public:
  BtSuccess(const std::string& name, const BT::NodeConfig& config) : SyncActionNode(name, config) {}
  static BT::PortsList providedPorts() { return {}; }
  BT::NodeStatus tick() override { return BT::NodeStatus::SUCCESS; }
};

class BtRead : public BT::SyncActionNode {
 public:
  BtRead(const std::string& name, const BT::NodeConfig& config) : SyncActionNode(name, config) {}
  static BT::PortsList providedPorts() { return {BT::InputPort<double>("a")}; }
  BT::NodeStatus tick() override {
    const auto value = getInput<double>("a");
    return value && *value >= 0 ? BT::NodeStatus::SUCCESS : BT::NodeStatus::FAILURE;
  }
};

}  // namespace

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<BtSuccess>("BtSuccess");
  factory.registerNodeType<BtRead>("BtRead");
}
