// The library's classes of nodes: loops over types of the user, classes registered under another
// ID, and classes that derive from them.
#include <iostream>

#include "behaviortree_cpp/actions/pop_from_queue.hpp"
#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/controls/reactive_sequence.h"
#include "behaviortree_cpp/decorators/loop_node.h"
#include "behaviortree_cpp/decorators/retry_node.h"

using namespace BT;

struct Pose2D {
  double x, y;
};

class MakePoses : public SyncActionNode {
 public:
  MakePoses(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {OutputPort<SharedQueue<Pose2D>>("shared"), OutputPort<std::vector<Pose2D>>("list"),
            OutputPort<std::shared_ptr<ProtectedQueue<Pose2D>>>("queue")};
  }
  NodeStatus tick() override {
    const auto shared = std::make_shared<std::deque<Pose2D>>();
    const auto queue = std::make_shared<ProtectedQueue<Pose2D>>();
    std::vector<Pose2D> list;
    for (int i = 0; i < 3; ++i) {
      shared->push_back({double(i), double(i)});
      queue->items.push_back({double(i), 2.0 * i});
      list.push_back({double(i), 3.0 * i});
    }
    setOutput("shared", shared);
    setOutput("queue", queue);
    setOutput("list", list);
    return NodeStatus::SUCCESS;
  }
};

class UsePose : public StatefulActionNode {
 public:
  UsePose(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<Pose2D>("target")}; }
  NodeStatus onStart() override {
    const auto pose = getInput<Pose2D>("target").value();
    std::cout << name() << " " << pose.x << " " << pose.y << std::endl;
    return NodeStatus::RUNNING;
  }
  NodeStatus onRunning() override { return NodeStatus::SUCCESS; }
  void onHalted() override { std::cout << name() << " halted" << std::endl; }
};

class Say : public SyncActionNode {
 public:
  Say(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort("text")}; }
  NodeStatus tick() override {
    std::cout << name() << " " << getInput<std::string>("text").value() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

// Succeeds in its third tick.
class Third : public SyncActionNode {
 public:
  explicit Third(const std::string& name) : SyncActionNode(name, {}) {}
  NodeStatus tick() override {
    std::cout << name() << " " << ++ticks_ << std::endl;
    return ticks_ < 3 ? NodeStatus::FAILURE : NodeStatus::SUCCESS;
  }

 private:
  int ticks_ = 0;
};

class Loud : public ReactiveSequence {
 public:
  explicit Loud(const std::string& name) : ReactiveSequence(name) {}
  NodeStatus executeTick() override {
    const NodeStatus result = ReactiveSequence::executeTick();
    std::cout << name() << " of " << childrenCount() << ": " << result << std::endl;
    return result;
  }
};

class Patient : public RetryNode {
 public:
  Patient(const std::string& name, const NodeConfig&) : RetryNode(name, 2) {}
  static PortsList providedPorts() { return {}; }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<LoopNode<Pose2D>>("LoopPose");
  factory.registerNodeType<PopFromQueue<Pose2D>>("PopPose");
  factory.registerNodeType<QueueSize<Pose2D>>("CountPoses");
  factory.registerNodeType<RetryNode>("Retry");
  factory.registerNodeType<AlwaysSuccessNode>("CheckDoor");
  factory.registerNodeType<SequenceNode>("InOrder");
  factory.registerNodeType<FallbackNode>("AnyOf");
  factory.registerNodeType<InverterNode>("Not");
  factory.registerNodeType<RepeatNode>("Again");
  factory.registerNodeType<ForceSuccessNode>("Anyway");
  factory.registerNodeType<KeepRunningUntilFailureNode>("Keep");
  factory.registerNodeType<RunOnceNode>("Once");
  factory.registerNodeType<SequenceWithMemory>("Remember");
  factory.registerNodeType<Loud>("Loud");
  factory.registerNodeType<Patient>("Patient");
  factory.registerNodeType<MakePoses>("MakePoses");
  factory.registerNodeType<UsePose>("UsePose");
  factory.registerNodeType<Say>("Say");
  factory.registerNodeType<Third>("Third");
}
