// Ports of pointers to a base and to classes that derive from it, which share entries.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

struct Tool {
  virtual ~Tool() = default;
  virtual std::string name() const { return "tool"; }
};
struct Gripper : Tool {
  std::string name() const override { return "gripper"; }
  int fingers = 2;
};
struct Hand : Gripper {
  Hand() { fingers = 5; }
  std::string name() const override { return "hand"; }
};
struct Drill : Tool {
  std::string name() const override { return "drill"; }
};

// Writes an object of class Made to a port of class Port.
template <class Made, class Port>
class Take : public SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() { return {OutputPort<std::shared_ptr<Port>>("tool")}; }
  NodeStatus tick() override {
    setOutput("tool", std::shared_ptr<Port>(std::make_shared<Made>()));
    return NodeStatus::SUCCESS;
  }
};

template <class Read>
class Use : public SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() { return {InputPort<std::shared_ptr<Read>>("tool")}; }
  NodeStatus tick() override {
    const auto tool = getInput<std::shared_ptr<Read>>("tool");
    std::cout << "  " << (tool ? name() + " " + (*tool)->name() : name() + " has none")
              << std::endl;
    return NodeStatus::SUCCESS;
  }
};

template <class Read>
class UseInThread : public ThreadedAction {
 public:
  using ThreadedAction::ThreadedAction;
  static PortsList providedPorts() { return {InputPort<std::shared_ptr<Read>>("tool")}; }
  NodeStatus tick() override {
    const auto tool = getInput<std::shared_ptr<Read>>("tool");
    std::cout << "  " << name() << (tool ? " " + (*tool)->name() : " has none") << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Change : public SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() { return {BidirectionalPort<std::shared_ptr<Tool>>("tool")}; }
  NodeStatus tick() override { return NodeStatus::SUCCESS; }
};

static void run(const std::string& nodes, bool are_related) {
  BehaviorTreeFactory factory;
  if (are_related) {
    factory.registerPolymorphicCast<Gripper, Tool>();
    factory.registerPolymorphicCast<Hand, Gripper>();
    factory.registerPolymorphicCast<Drill, Tool>();
  }
  factory.registerNodeType<Take<Gripper, Gripper>>("TakeGripper");
  factory.registerNodeType<Take<Hand, Hand>>("TakeHand");
  factory.registerNodeType<Take<Tool, Tool>>("TakeTool");
  factory.registerNodeType<Take<Hand, Tool>>("TakeHandAsTool");
  factory.registerNodeType<Take<Hand, Gripper>>("TakeHandAsGripper");
  factory.registerNodeType<Use<Tool>>("UseTool");
  factory.registerNodeType<Use<Gripper>>("UseGripper");
  factory.registerNodeType<Use<Hand>>("UseHand");
  factory.registerNodeType<Use<Drill>>("UseDrill");
  factory.registerNodeType<UseInThread<Tool>>("UseToolInThread");
  factory.registerNodeType<Change>("Change");
  std::cout << nodes << (are_related ? "" : " (not related)") << std::endl;
  std::string text;
  std::string rest = nodes + " ";
  for (std::size_t end = rest.find(' '); end != std::string::npos; end = rest.find(' ')) {
    text += "<" + rest.substr(0, end) + " tool=\"{tool}\"/>";
    rest.erase(0, end + 1);
  }
  try {
    auto tree =
        factory.createTreeFromText("<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence>" +
                                   text + "</Sequence></BehaviorTree></root>");
    const NodeStatus status = tree.tickWhileRunning();
    std::cout << "  " << status << std::endl;
  } catch (const std::exception&) {
    std::cout << "  is refused" << std::endl;
  }
}

static void use_registry() {
  PolymorphicCastRegistry casts;
  casts.registerCast<Gripper, Tool>();
  casts.registerCast<Hand, Gripper>();
  const auto tell = [&casts](const char* what, const Any& value) {
    std::cout << what << ": " << value.tryCastWithRegistry<std::shared_ptr<Tool>>(casts).has_value()
              << value.tryCastWithRegistry<std::shared_ptr<Gripper>>(casts).has_value()
              << value.tryCastWithRegistry<std::shared_ptr<Hand>>(casts).has_value()
              << value.tryCastWithRegistry<std::shared_ptr<Drill>>(casts).has_value() << std::endl;
  };
  tell("a tool", Any(std::make_shared<Tool>()));
  tell("a gripper", Any(std::make_shared<Gripper>()));
  tell("a hand", Any(std::make_shared<Hand>()));
  tell("a hand as a tool", Any(std::shared_ptr<Tool>(std::make_shared<Hand>())));
  tell("a drill", Any(std::make_shared<Drill>()));
  tell("a null hand", Any(std::shared_ptr<Hand>()));
  tell("a null tool", Any(std::shared_ptr<Tool>()));
  tell("a number", Any(1));
  tell("nothing", Any());
  const std::type_index tool = typeid(std::shared_ptr<Tool>);
  const std::type_index gripper = typeid(std::shared_ptr<Gripper>);
  const std::type_index hand = typeid(std::shared_ptr<Hand>);
  std::cout << "bases of hand: " << casts.getBaseTypes(hand).size() << ", "
            << casts.getBaseTypes(hand).count(gripper) << ", up " << casts.canUpcast(hand, tool)
            << casts.canUpcast(tool, hand) << casts.canUpcast(tool, tool) << ", convertible "
            << casts.isConvertible(hand, tool) << casts.isConvertible(gripper, hand) << std::endl;
  casts.clear();
  std::cout << "cleared: " << casts.isConvertible(hand, gripper) << std::endl;
}

int main() {
  use_registry();
  run("TakeGripper UseGripper UseTool UseToolInThread", true);
  run("TakeHand UseTool UseGripper UseHand", true);
  run("TakeHandAsTool UseGripper UseTool", true);
  run("TakeHandAsGripper UseHand", true);
  run("TakeTool UseGripper", true);
  run("TakeGripper UseDrill", true);
  run("TakeGripper UseTool", false);
  run("TakeGripper Change", true);
  run("UseTool TakeGripper", true);
  run("TakeTool TakeGripper", true);
  return 0;
}
