// Children that a control node ticks again without resetting them: each has the status that it had.
#include "own_status.h"

// Ticks all children in each tick, whatever they return, until the last one has completed.
class Pipeline : public ControlNode {
 public:
  Pipeline(const std::string& name, const NodeConfig& config) : ControlNode(name, config) {}
  static PortsList providedPorts() { return {}; }

 private:
  NodeStatus tick() override {
    setStatus(NodeStatus::RUNNING);
    NodeStatus last = NodeStatus::IDLE;
    for (TreeNode* child : children_nodes_) last = child->executeTick();
    if (last == NodeStatus::RUNNING) return last;
    haltChildren();
    return last;
  }
};

// Ticks its child in every n-th tick since it began, and succeeds in between.
class Every : public DecoratorNode {
 public:
  Every(const std::string& name, const NodeConfig& config) : DecoratorNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("n")}; }

 private:
  NodeStatus tick() override {
    if (!isStatusActive(status())) {
      std::cout << name() << " begins" << std::endl;
      count_ = 0;
    }
    setStatus(NodeStatus::RUNNING);
    const bool is_due = count_++ % getInput<int>("n").value() == 0;
    return is_due ? child_node_->executeTick() : NodeStatus::SUCCESS;
  }

  int count_ = 0;
};

class Look : public SyncActionNode {
 public:
  Look(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<std::string>("text", "-", "")}; }
  NodeStatus tick() override {
    std::cout << name() << " " << status() << " " << getInput<std::string>("text").value()
              << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Coroutine : public CoroActionNode {
 public:
  Coroutine(const std::string& name, const NodeConfig& config) : CoroActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    std::cout << name() << " begins" << std::endl;
    setStatusRunningAndYield();
    return NodeStatus::SUCCESS;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Pipeline>("Pipeline");
  factory.registerNodeType<Every>("Every");
  factory.registerNodeType<Look>("Look");
  factory.registerNodeType<Ask>("Ask");
  factory.registerNodeType<Raw>("Raw");
  factory.registerNodeType<Coroutine>("Coroutine");
  factory.registerNodeType<Steps>("Steps");
  factory.registerSimpleAction("Say", [](TreeNode& node) {
    std::cout << node.name() << " " << node.status() << std::endl;
    return NodeStatus::SUCCESS;
  });
}
