// A program that ticks a tree itself.
#include <behaviortree_cpp/bt_factory.h>

#include <iostream>

using namespace BT;

class Count : public StatefulActionNode {
 public:
  Count(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("to"), OutputPort<int>("at")}; }

  NodeStatus onStart() override {
    at_ = 0;
    return onRunning();
  }
  NodeStatus onRunning() override {
    setOutput("at", ++at_);
    return at_ >= getInput<int>("to").value() ? NodeStatus::SUCCESS : NodeStatus::RUNNING;
  }
  void onHalted() override { std::cout << name() << " halted" << std::endl; }

 private:
  int at_ = 0;
};

static const char* const kTree = R"(
<root BTCPP_format="4">
  <BehaviorTree ID="Main">
    <Sequence>
      <Count name="counter" to="{to}" at="{at}"/>
      <Say/>
      <Greet/>
    </Sequence>
  </BehaviorTree>
</root>)";

int main(int, char** arguments) {
  BehaviorTreeFactory factory;
  factory.registerNodeType<Count>("Count");
  factory.registerSimpleAction("Say", [](TreeNode& node) {
    std::cout << node.name() << std::endl;
    return NodeStatus::SUCCESS;
  });
  factory.registerFromPlugin(arguments[1]);

  auto blackboard = Blackboard::create();
  blackboard->set("to", 3);
  auto tree = factory.createTreeFromText(kTree, blackboard);
  NodeStatus status = NodeStatus::RUNNING;
  int ticks = 0;
  for (; status == NodeStatus::RUNNING; ++ticks) status = tree.tickOnce();
  std::cout << status << " after " << ticks << ", at " << tree.rootBlackboard()->get<int>("at")
            << std::endl;

  tree.rootBlackboard()->set("to", 2);
  std::cout << tree.tickWhileRunning(std::chrono::milliseconds(1)) << " at "
            << blackboard->get<int>("at") << std::endl;
  tree.tickExactlyOnce();
  tree.haltTree();

  try {
    (void)factory.createTreeFromText(
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Other\"><Unknown/></BehaviorTree></root>");
  } catch (const std::exception&) {
    std::cout << "refused" << std::endl;
  }
}
