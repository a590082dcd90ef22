// Each MISTAKE is one that authors of nodes for BehaviorTree.CPP make, or something of that library
// that lockstep has not.
#include <memory>

#include "behaviortree_cpp/actions/script_node.h"
#include "behaviortree_cpp/actions/test_node.h"
#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/controls/parallel_node.h"
#include "behaviortree_cpp/controls/switch_node.h"
#include "behaviortree_cpp/decorators/timeout_node.h"
#include "behaviortree_cpp/loggers/bt_file_logger_v2.h"
#include "behaviortree_cpp/loggers/bt_minitrace_logger.h"
#include "behaviortree_cpp/loggers/bt_observer.h"
#include "behaviortree_cpp/loggers/bt_sqlite_logger.h"
#include "behaviortree_cpp/loggers/groot2_publisher.h"
#include "behaviortree_cpp/xml_parsing.h"

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
  const Groot2Publisher publisher(tree);
#elif MISTAKE == 7
  writeTreeNodesModelXML(factory);
#elif MISTAKE == 8
  factory.registerNodeType<WhileDoElseNode>("AsLong");
#elif MISTAKE == 9
  factory.addSubstitutionRule("talk", TestNodeConfig());
#elif MISTAKE == 10
#include "behaviortree_cpp/scripting/script_parser.hpp"
#elif MISTAKE == 11
#include "behaviortree_cpp/loggers/groot2_protocol.h"
#elif MISTAKE == 12
#include "behaviortree_cpp/utils/polymorphic_cast_registry.hpp"
#elif MISTAKE == 13
  auto tree = factory.createTreeFromText("");
  const FileLogger2 file(tree, "run.btlog");
  const SqliteLogger table(tree, "run.db3");
  const MinitraceLogger trace(tree, "run.json");
  const TreeObserver observer(tree);
  WriteTreeToXML(tree);
  factory.registerNodeType<TestNode>("Test");
  factory.registerNodeType<SwitchNode<2> >("Choice");
  factory.registerNodeType<TimeoutNode>("Soon");
#elif MISTAKE == 14
  factory.registerNodeType<ParallelNode>("All");
  factory.registerNodeType<ScriptNode>("Code");
  const auto function = ParseScript("a := 1");
  const auto copy = BlackboardBackup(*factory.createTreeFromText("").rootBlackboard());
#endif
}
