// A plugin of nodes for navigation.
#include "navigation_nodes.h"

#include <iostream>

// Time goes on with each tick of it, and the robot moves.
class Drive : public BT::StatefulActionNode {
 public:
  Drive(const std::string& name, const BT::NodeConfiguration& config, navigation::Robot::Ptr robot)
      : BT::StatefulActionNode(name, config), robot_(std::move(robot)) {}
  static BT::PortsList providedPorts() { return {BT::InputPort<int>("ticks", 10, "how many")}; }
  BT::NodeStatus onStart() override {
    left_ = getInput<int>("ticks").value();
    return onRunning();
  }
  BT::NodeStatus onRunning() override {
    robot_->seconds += 0.5;
    robot_->x += 0.25;
    if (left_ == 3) robot_->goal = 7;
    return left_-- > 0 ? BT::NodeStatus::RUNNING : BT::NodeStatus::SUCCESS;
  }
  void onHalted() override { robot_->log(name() + " stops"); }

 private:
  navigation::Robot::Ptr robot_;
  int left_ = 0;
};

BT_REGISTER_NODES(factory) {
  auto robot = std::make_shared<navigation::Robot>();
  robot->log = [](const std::string& text) { std::cerr << text << std::endl; };
  navigation::register_nodes(factory, robot);
  factory.registerNodeType<Drive>("Drive", robot);
}
