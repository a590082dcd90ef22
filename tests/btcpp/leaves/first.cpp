// One node of each common kind, as a tutorial has them.
#include <iostream>
#include <map>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

struct Position {
  double x = 0, y = 0;
};

namespace BT {
template <>
inline Position convertFromString(StringView text) {
  const auto parts = splitString(text, ';');
  if (parts.size() != 2) throw RuntimeError("a position is two numbers");
  return {convertFromString<double>(parts[0]), convertFromString<double>(parts[1])};
}
}  // namespace BT

class Approach : public SyncActionNode {
 public:
  explicit Approach(const std::string& name) : SyncActionNode(name, {}) {}

  NodeStatus tick() override {
    std::cout << "approach: " << this->name() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Say : public SyncActionNode {
 public:
  Say(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<std::string>("message")}; }

  NodeStatus tick() override {
    Expected<std::string> message = getInput<std::string>("message");
    if (!message) throw RuntimeError("missing required input [message]: ", message.error());
    std::cout << "says: " << message.value() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Think : public SyncActionNode {
 public:
  Think(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {OutputPort<std::string>("text")}; }

  NodeStatus tick() override {
    setOutput("text", "the answer is 42");
    return NodeStatus::SUCCESS;
  }
};

class Move : public StatefulActionNode {
 public:
  Move(const std::string& name, const NodeConfiguration& config)
      : StatefulActionNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<Position>("goal"), InputPort<int>("ticks", 3, "how long it takes")};
  }

  NodeStatus onStart() override {
    Position goal;
    if (!getInput("goal", goal)) return NodeStatus::FAILURE;
    std::cout << "move to " << goal.x << " " << goal.y << std::endl;
    done_ = 0;
    ticks_ = getInput<int>("ticks").value();
    return NodeStatus::RUNNING;
  }
  NodeStatus onRunning() override {
    return ++done_ >= ticks_ ? NodeStatus::SUCCESS : NodeStatus::RUNNING;
  }
  void onHalted() override { std::cout << name() << " halted" << std::endl; }

 private:
  int done_ = 0, ticks_ = 1;
};

class IsClose : public ConditionNode {
 public:
  IsClose(const std::string& name, const NodeConfig& config) : ConditionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<double>("distance")}; }

  NodeStatus tick() override {
    return getInput<double>("distance").value() < 1 ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }
};

// Its port has a type that no text is converted to.
class Look : public SyncActionNode {
 public:
  Look(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<std::map<std::string, std::vector<Position>>>("places")};
  }
  NodeStatus tick() override {
    const auto places = getInput<std::map<std::string, std::vector<Position>>>("places");
    if (!places) throw RuntimeError(places.error());
    return NodeStatus::SUCCESS;
  }
};

static NodeStatus check_battery() {
  std::cout << "battery: ok" << std::endl;
  return NodeStatus::SUCCESS;
}

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Approach>("Approach");
  factory.registerNodeType<Say>("Say");
  factory.registerNodeType<Think>("Think");
  factory.registerNodeType<Move>("Move");
  factory.registerNodeType<IsClose>("IsClose");
  factory.registerNodeType<Look>("Look");
  factory.registerSimpleCondition("BatteryOk", [](TreeNode&) { return check_battery(); });
}
