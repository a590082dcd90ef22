// What a node may ask and set: entries by name, ports, its status, calls around its ticks; and what
// a factory knows.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"
using namespace BT;
enum class Color { Red = 1, Green = 2 };
struct Point {
  double x, y;
};
class Go : public StatefulActionNode {
 public:
  Go(const std::string& n, const NodeConfig& c) : StatefulActionNode(n, c) {
    changes_ =
        subscribeToStatusChange([](TimePoint, const TreeNode& node, NodeStatus a, NodeStatus b) {
          if (b != NodeStatus::IDLE)
            std::cout << node.name() << " " << a << " -> " << b << std::endl;
        });
  }
  static PortsList providedPorts() {
    return {InputPort<int>("n"),       OutputPort<double>("out"),
            InputPort<Color>("color"), BidirectionalPort<std::string>("text"),
            InputPort<Point>("p"),     OutputPort<Point>("q")};
  }
  NodeStatus onStart() override {
    auto bb = config().blackboard;
    bb->set("whole", 5);
    bb->set("real", 2.5);
    bb->set("word", std::string("hi"));
    bb->set("p", Point{1, 2});
    bb->set("flag", true);
    std::cout << bb->get<int>("whole") << bb->get<double>("real") << bb->get<std::string>("word")
              << bb->get<Point>("p").y << bb->get<bool>("flag") << std::endl;
    if (auto entry = bb->getEntry("whole"))
      std::cout << "entry " << entry->value.cast<int>() << std::endl;
    std::cout << (bb->getEntry("nothing") == nullptr) << std::endl;
    int out = 7;
    std::cout << bb->get("nothing", out) << out << bb->get("whole", out) << out << std::endl;
    try {
      (void)bb->get<int>("nothing");
    } catch (const BT::RuntimeError&) {
      std::cout << "RuntimeError" << std::endl;
    } catch (const std::exception&) {
      std::cout << "other" << std::endl;
    }
    try {
      (void)bb->get<int>("word");
    } catch (const BT::RuntimeError&) {
      std::cout << "RuntimeError" << std::endl;
    } catch (const std::exception&) {
      std::cout << "other" << std::endl;
    }
    if (auto any = bb->getAnyLocked("whole")) {
      bool there = any;
      std::cout << there << any->cast<int>() << std::endl;
      any.assign(9);
    }
    std::cout << bb->get<int>("whole") << std::endl;
    if (auto any = bb->getAnyLocked("p")) {
      any->castPtr<Point>()->x = 42;
    }
    std::cout << bb->get<Point>("p").x << std::endl;
    bb->unset("whole");
    std::cout << (bb->getEntry("whole") == nullptr) << std::endl;
    bb->set("@top", 3);
    std::cout << bb->get<int>("@top") << bb->rootBlackboard()->get<int>("top") << std::endl;
    std::cout << getInput<int>("n").value_or(-1) << " " << int(getInput<Color>("color").value())
              << std::endl;
    std::string text;
    std::cout << bool(getInput("text", text)) << text << std::endl;
    std::cout << bool(setOutput("text", std::string("new")))
              << getInput<std::string>("text").value() << std::endl;
    std::cout << bool(setOutput("out", 3)) << bool(setOutput("nope", 3)) << bool(setOutput("n", 3))
              << std::endl;
    std::cout << getRawPortValue("n") << " " << getRawPortValue("out") << std::endl;
    if (auto any = getLockedPortContent("text"))
      std::cout << any->isString() << any->cast<std::string>() << std::endl;
    std::cout << bool(getLockedPortContent("n")) << std::endl;
    setOutput("q", Point{3, 4});
    std::cout << getInput<Point>("p")->x << std::endl;
    std::cout << parseString<int>("12") << int(parseString<Color>("Green"))
              << int(parseString<Color>("7")) << std::endl;
    std::cout << isHaltRequested() << status() << std::endl;
    return NodeStatus::RUNNING;
  }
  NodeStatus onRunning() override { return NodeStatus::SUCCESS; }
  void onHalted() override {}

 private:
  StatusChangeSubscriber changes_;
};
class Watched : public SyncActionNode {
 public:
  Watched(const std::string& n, const NodeConfig& c) : SyncActionNode(n, c) {
    setPreTickFunction([](TreeNode& node) {
      std::cout << "before " << node.name() << std::endl;
      return node.name() == "not" ? NodeStatus::FAILURE : NodeStatus::IDLE;
    });
    setPostTickFunction([](TreeNode&, NodeStatus s) {
      std::cout << "after " << s << std::endl;
      return NodeStatus::IDLE;
    });
    setTickMonitorCallback([](TreeNode&, NodeStatus s, std::chrono::microseconds) {
      std::cout << "monitor " << s << std::endl;
    });
  }
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    std::cout << "tick" << std::endl;
    return NodeStatus::SUCCESS;
  }
};
BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Go>("Go");
  factory.registerNodeType<Watched>("Watched");
  factory.registerScriptingEnums<Color>();
  std::cout << factory.builtinNodes().count("Sequence") << factory.manifests().count("Go")
            << factory.builders().count("Go") << factory.unregisterBuilder("Nope") << std::endl;
  factory.registerSimpleAction("Gone", [](TreeNode&) { return NodeStatus::SUCCESS; });
  std::cout << factory.unregisterBuilder("Gone") << factory.manifests().count("Gone") << std::endl;
  factory.addMetadataToManifest("Go", {{"foo", "bar"}});
  std::cout << factory.manifests().at("Go").metadata.size()
            << (factory.manifests().find("Go") != factory.manifests().end()) << std::endl;
  auto node = factory.instantiateTreeNode("solo", "Watched", {});
  std::cout << node->name() << node->registrationName() << node->executeTick() << node->status()
            << std::endl;
}
