// Each MISTAKE is one that authors of nodes for BehaviorTree.CPP make, or something of that library
// that lockstep has not. -1: all at once, of which each is reported in other words.
#include <memory>

#include "behaviortree_cpp/actions/script_node.h"
#include "behaviortree_cpp/actions/test_node.h"
#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/loggers/bt_sqlite_logger.h"

#define IS_MISTAKE(number) (MISTAKE == (number) || MISTAKE == -1)

using namespace BT;

struct Point {
  double x = 0;
};

class Good : public SyncActionNode {
 public:
  Good(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
#if IS_MISTAKE(1)
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
#if IS_MISTAKE(2)
  factory.registerNodeType<Abstract>("Abstract");
#endif
#if IS_MISTAKE(3)
  factory.registerNodeType<NoPorts>("NoPorts");
#endif
#if IS_MISTAKE(4)
  factory.registerNodeType<NoConfig>("NoConfig");
#endif
#if IS_MISTAKE(5)
  factory.registerNodeType<NoNode>("NoNode");
#endif
#if IS_MISTAKE(6)
  auto tree = factory.createTreeFromText("");
  const SqliteLogger table(tree, "run.db3");
#endif
#if IS_MISTAKE(7)
  factory.registerNodeType<TestNode>("Test");
#endif
#if IS_MISTAKE(8)
  factory.registerNodeType<ManualSelectorNode>("Pick");
#endif
#if IS_MISTAKE(9)
  factory.registerNodeType<ScriptNode>("Code");
#endif
#if IS_MISTAKE(10)
#include "behaviortree_cpp/loggers/bt_zmq_publisher.h"
#endif
#if IS_MISTAKE(11)
  factory.registerPolymorphicCast<Good, Abstract>();
#endif
#if IS_MISTAKE(12)
  const PortInfo port(PortDirection::INPUT, typeid(int), [](StringView) { return Any(1); });
#endif
}
