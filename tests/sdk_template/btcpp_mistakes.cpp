// Each MISTAKE is one that authors of nodes for BehaviorTree.CPP make, or something of that library
// that lockstep has not.
#include <memory>

#include "behaviortree_cpp/actions/script_node.h"
#include "behaviortree_cpp/actions/test_node.h"
#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/loggers/bt_sqlite_logger.h"

using namespace BT;

struct Point {
  double x = 0;
};

class Good : public SyncActionNode {
 public:
  Good(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
#if MISTAKE == 1
    return {InputPort<Point>("point", std::make_unique<int>(1), "a point")};
#else
    return {InputPort<Point>("point", Point{1}, "a point")};
#endif
  }
  NodeStatus tick() override {
    return NodeStatus::SUCCESS;
  }
};

class Abstract : public StatefulActionNode {
 public:
  Abstract(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus onStart() override { return NodeStatus::SUCCESS; }
};

class NoPorts : public SyncActionNode {
 public:
  NoPorts(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  NodeStatus tick() override { return NodeStatus::SUCCESS; }
};

class NoConfig : public SyncActionNode {
 public:
  explicit NoConfig(const std::string& name) : SyncActionNode(name, {}) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override { return NodeStatus::SUCCESS; }
};

class NoNode {};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Good>("Good");
#if MISTAKE == 2
  factory.registerNodeType<Abstract>("Abstract");
#elif MISTAKE == 3
  factory.registerNodeType<NoPorts>("NoPorts");
#elif MISTAKE == 4
  factory.registerNodeType<NoConfig>("NoConfig");
#elif MISTAKE == 5
  factory.registerNodeType<NoNode>("NoNode");
#elif MISTAKE == 6
  auto tree = factory.createTreeFromText("");
  const SqliteLogger table(tree, "run.db3");
#elif MISTAKE == 7
  factory.registerNodeType<TestNode>("Test");
#elif MISTAKE == 8
  factory.registerNodeType<ManualSelectorNode>("Pick");
#elif MISTAKE == 9
  factory.registerNodeType<ScriptNode>("Code");
#elif MISTAKE == 10
#include "behaviortree_cpp/loggers/bt_zmq_publisher.h"
#elif MISTAKE == 11
  factory.registerPolymorphicCast<Good, Abstract>();
#elif MISTAKE == 12
  const PortInfo port(PortDirection::INPUT, typeid(int), [](StringView) { return Any(1); });
#endif
}
