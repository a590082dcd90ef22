// A node of a plugin that takes a driver of its program from the blackboard, in its constructor.
#include "driver.h"

#include "behaviortree_cpp/bt_factory.h"

class Use : public BT::SyncActionNode {
 public:
  Use(const std::string& name, const BT::NodeConfig& config)
      : SyncActionNode(name, config), driver_(config.blackboard->get<Driver::Ptr>("driver")) {}
  static BT::PortsList providedPorts() { return {}; }
  BT::NodeStatus tick() override {
    config().blackboard->set("way", Way{++driver_->used});
    return BT::NodeStatus::SUCCESS;
  }

 private:
  Driver::Ptr driver_;
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Use>("Use");
}
