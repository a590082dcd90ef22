// A program that looks at the nodes of its tree, and shares a blackboard with it.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/json_export.h"

using namespace BT;

// Gets what it needs from a visitor.
class Tell : public SyncActionNode {
 public:
  Tell(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("number"), OutputPort<int>("next")}; }
  void initialize(const std::string& what) { what_ = what; }
  NodeStatus tick() override {
    const int number = getInput<int>("number").value();
    setOutput("next", number + 1);
    std::cout << name() << ": " << what_ << " " << number << std::endl;
    return NodeStatus::SUCCESS;
  }

 private:
  std::string what_ = "nothing";
};

class Wait : public StatefulActionNode {
 public:
  Wait(const std::string& name, const NodeConfig& config) : StatefulActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus onStart() override { return NodeStatus::RUNNING; }
  NodeStatus onRunning() override { return NodeStatus::RUNNING; }
  void onHalted() override { std::cout << name() << " halted" << std::endl; }
};

static const char* const kMain = R"(
<root BTCPP_format="4">
  <BehaviorTree ID="Main">
    <Sequence>
      <Tell name="first" number="{@shared}" next="{@shared}"/>
      <SubTree ID="Part" name="mine" number="{@shared}" next="{next}"/>
      <SubTree ID="Part" name="other" number="7" next="{last}"/>
      <Inverter><Wait/></Inverter>
    </Sequence>
  </BehaviorTree>
</root>)";

static const char* const kPart = R"(
<root BTCPP_format="4">
  <BehaviorTree ID="Part">
    <Fallback name="any"><AlwaysFailure/><Tell number="{number}" next="{next}"/></Fallback>
  </BehaviorTree>
</root>)";

struct Pose {
  double x = 0, y = 0;
};
BT_JSON_CONVERTER(Pose, pose) {
  add_field("x", &pose.x);
  add_field("y", &pose.y);
}

// A program gives an object to a tree, and gets one.
static void share_objects(BehaviorTreeFactory& factory) {
  RegisterJsonDefinition<Pose>();
  factory.registerSimpleAction("Mirror",
                               [](TreeNode& node) {
                                 const auto pose = node.getInput<Pose>("from").value();
                                 node.setOutput("to", Pose{pose.y, pose.x});
                                 return NodeStatus::SUCCESS;
                               },
                               {InputPort<Pose>("from"), OutputPort<Pose>("to")});
  auto tree = factory.createTreeFromText(
      R"(<root BTCPP_format="4" main_tree_to_execute="Mirrors">
           <BehaviorTree ID="Mirrors"><Mirror from="{from}" to="{to}"/></BehaviorTree></root>)");
  tree.subtrees.front()->blackboard->set("from", Pose{1.5, 2});
  std::cout << tree.tickOnce() << " " << toStr(tree.rootBlackboard()->get<Pose>("to")) << std::endl;
}

// What a program sees of a node that throws.
static void fail(BehaviorTreeFactory& factory) {
  factory.registerSimpleAction(
      "Broken", [](TreeNode&) -> NodeStatus { throw std::runtime_error("it is broken"); });
  auto tree = factory.createTreeFromText(
      R"(<root BTCPP_format="4" main_tree_to_execute="Fails">
           <BehaviorTree ID="Fails"><Sequence><AlwaysSuccess/><Broken/></Sequence></BehaviorTree></root>)");
  try {
    tree.tickOnce();
  } catch (const NodeExecutionError& error) {
    std::cout << error.what() << std::endl
              << error.failedNode().node_path << std::endl
              << error.originalMessage() << std::endl;
  }
}

// An ID is registered once, and no built-in node is replaced.
static void register_again(BehaviorTreeFactory& factory) {
  for (const char* id : {"Tell", "Sequence"}) {
    try {
      factory.registerNodeType<Tell>(id);
      std::cout << id << " is replaced" << std::endl;
    } catch (const BehaviorTreeException&) {
      std::cout << id << " stays" << std::endl;
    }
  }
}

int main() {
  BehaviorTreeFactory factory;
  factory.registerNodeType<Tell>("Tell");
  factory.registerNodeType<Wait>("Wait");
  factory.registerBehaviorTreeFromText(kPart);
  factory.registerBehaviorTreeFromText(kMain);
  for (const std::string& tree : factory.registeredBehaviorTrees()) std::cout << tree << std::endl;

  const auto shared = Blackboard::create();
  shared->set("shared", 40);
  auto tree = factory.createTree("Main", Blackboard::create(shared));
  printTreeRecursively(tree.rootNode());
  tree.applyVisitor([](TreeNode* node) {
    std::cout << node->UID() << " " << node->fullPath() << " " << node->registrationName() << " "
              << node->type() << " " << node->status() << std::endl;
    if (auto* const tell = dynamic_cast<Tell*>(node)) tell->initialize("visited");
  });
  for (const auto& part : tree.subtrees) {
    std::cout << "[" << part->instance_name << "] " << part->nodes.size() << std::endl;
  }
  for (const TreeNode* node : tree.getNodesByPath("mine/*")) std::cout << node->name() << std::endl;
  std::cout << tree.getNodesByPath<Tell>("*").size() << std::endl;

  std::cout << tree.tickOnce() << std::endl;
  std::cout << tree.tickOnce() << " " << tree.rootNode()->status() << std::endl;
  std::cout << shared->get<int>("shared") << " " << tree.rootBlackboard()->get<int>("next") << " "
            << tree.subtrees[2]->blackboard->get<int>("number") << std::endl;
  tree.rootNode()->haltNode();
  shared->set("shared", 100);
  std::cout << tree.tickOnce() << std::endl;
  tree.haltTree();
  tree.emitWakeUpSignal();
  std::cout << tree.sleep(std::chrono::seconds(60)) << std::endl;
  fail(factory);
  share_objects(factory);
  register_again(factory);
}
