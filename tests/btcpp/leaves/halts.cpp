// Actions that take time: when their functions are called, and what they see.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

class Work : public StatefulActionNode {
 public:
  Work(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<int>("ticks"),
            InputPort<NodeStatus>("result", NodeStatus::SUCCESS, "at the end")};
  }

  NodeStatus onStart() override {
    say("start");
    left_ = getInput<int>("ticks").value();
    return step();
  }
  NodeStatus onRunning() override {
    say("running");
    return step();
  }
  void onHalted() override { say("halted"); }

 private:
  NodeStatus step() { return left_-- > 0 ? NodeStatus::RUNNING : NodeStatus::SUCCESS; }
  void say(const char* what) {
    std::cout << name() << " " << what << " " << status() << " " << isHaltRequested() << std::endl;
  }
  int left_ = 0;
};

// Counts how often it was asked; true from the third time on.
class Third : public ConditionNode {
 public:
  Third(const std::string& name, const NodeConfig& config) : ConditionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    std::cout << name() << " " << ++asked_ << std::endl;
    return asked_ >= 3 ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }

 private:
  int asked_ = 0;
};

// The old way: the class keeps its own status.
class Classic : public ActionNodeBase {
 public:
  Classic(const std::string& name, const NodeConfig& config) : ActionNodeBase(name, config) {}
  static PortsList providedPorts() { return {}; }

  NodeStatus tick() override {
    if (status() == NodeStatus::IDLE) {
      std::cout << name() << " begins" << std::endl;
      setStatus(NodeStatus::RUNNING);
      count_ = 0;
    }
    return ++count_ < 3 ? NodeStatus::RUNNING : NodeStatus::SUCCESS;
  }
  void halt() override {
    // At the end, the library halts what does not run, too.
    if (status() == NodeStatus::RUNNING) std::cout << name() << " halts" << std::endl;
    resetStatus();
  }

 private:
  int count_ = 0;
};

class Skipped : public SyncActionNode {
 public:
  Skipped(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    std::cout << name() << " " << isHalted() << std::endl;
    return NodeStatus::SKIPPED;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Work>("Work");
  factory.registerNodeType<Third>("Third");
  factory.registerNodeType<Classic>("Classic");
  factory.registerNodeType<Skipped>("Skip");
}
