// Leaves that look at the status that they had.
#pragma once

#include <iostream>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

// Fails when it begins.
class Ask : public ConditionNode {
 public:
  Ask(const std::string& name, const NodeConfig& config) : ConditionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    std::cout << name() << " " << status() << std::endl;
    return isStatusActive(status()) ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }
};

// Runs for one tick.
class Raw : public ActionNodeBase {
 public:
  Raw(const std::string& name, const NodeConfig& config) : ActionNodeBase(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    std::cout << name() << " " << status() << std::endl;
    return isStatusActive(status()) ? NodeStatus::SUCCESS : NodeStatus::RUNNING;
  }
  void halt() override { resetStatus(); }
};

class Steps : public StatefulActionNode {
 public:
  Steps(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("n")}; }
  NodeStatus onStart() override {
    std::cout << name() << " starts" << std::endl;
    left_ = getInput<int>("n").value();
    return NodeStatus::RUNNING;
  }
  NodeStatus onRunning() override {
    std::cout << name() << " " << left_ << std::endl;
    return --left_ > 0 ? NodeStatus::RUNNING : NodeStatus::SUCCESS;
  }
  void onHalted() override { std::cout << name() << " halted" << std::endl; }

 private:
  int left_ = 0;
};
