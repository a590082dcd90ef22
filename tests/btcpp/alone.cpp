// A plugin that has the headers alone: no library, and the macro that a build for BehaviorTree.CPP
// gives.
#include "behaviortree_cpp/bt_factory.h"

class Ready : public BT::SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static BT::PortsList providedPorts() { return {BT::InputPort<int>("times")}; }
  BT::NodeStatus tick() override {
    return getInput<int>("times") == 2 ? BT::NodeStatus::SUCCESS : BT::NodeStatus::FAILURE;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Ready>("Ready");
}
