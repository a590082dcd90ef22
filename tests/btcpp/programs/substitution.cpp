// A program that replaces nodes of its trees for a test.
#include <chrono>
#include <iostream>
#include <memory>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

class Drive : public SyncActionNode {
 public:
  Drive(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("meters")}; }
  NodeStatus tick() override {
    std::cout << name() << " drives " << getInput<int>("meters").value() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

// Has a port of the same name.
class Pretend : public SyncActionNode {
 public:
  Pretend(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("meters")}; }
  NodeStatus tick() override {
    std::cout << fullPath() << " pretends, " << getInput<int>("meters").value() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

// The DOCTYPE is passed over, as the library does it.
static const char* const kTrees = R"(
<!DOCTYPE root [<!ENTITY leg "left">]>
<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Sequence>
      <Script code="result := 'none'; count := 0"/>
      <SubTree ID="Leg" name="first" meters="1" result="{result}" count="{count}"/>
      <Inverter name="not"><SubTree ID="Leg" name="second" meters="2" result="{result}"
          count="{count}"/></Inverter>
      <Drive name="home" meters="3" _post="count += 1"/>
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Leg">
    <Sequence name="leg"><Drive name="go" meters="{meters}"/></Sequence>
  </BehaviorTree>
</root>)";

// Nodes as they are; then how the tree ends.
static void tell(BehaviorTreeFactory& factory, const char* what) {
  std::cout << "-- " << what << std::endl;
  Tree tree = factory.createTreeFromText(kTrees);
  const NodeStatus status = tree.tickWhileRunning(std::chrono::milliseconds(1));
  std::cout << toStr(status) << ", " << tree.rootBlackboard()->get<std::string>("result") << ", "
            << tree.rootBlackboard()->get<int>("count") << std::endl;
  for (const auto& subtree : tree.subtrees) {
    for (const auto& node : subtree->nodes) {
      if (node->name() != "go" && node->name() != "home" && node->name() != "second") continue;
      std::cout << "  " << node->fullPath() << " " << node->registrationName() << " "
                << toStr(node->type()) << " " << subtree->tree_ID << std::endl;
    }
  }
}

int main() {
  BehaviorTreeFactory factory;
  factory.registerNodeType<Drive>("Drive");
  factory.registerNodeType<Pretend>("Pretend");
  factory.registerScriptingEnum("SEVEN", 7);
  tell(factory, "no rule");

  TestNodeConfig fails;
  fails.return_status = NodeStatus::FAILURE;
  fails.failure_script = "result := 'it failed'";
  fails.post_script = "count := SEVEN";
  factory.addSubstitutionRule("second/g*", fails);
  tell(factory, "by path: one of two");

  factory.clearSubstitutionRules();
  factory.addSubstitutionRule("go", "Pretend");
  tell(factory, "by name, another node");

  factory.clearSubstitutionRules();
  TestNodeConfig waits;
  waits.async_delay = std::chrono::milliseconds(5);
  waits.success_script = "count += 10";
  factory.addSubstitutionRule("Drive", waits);
  tell(factory, "by ID, with a delay");

  // What is shared may change between ticks.
  factory.clearSubstitutionRules();
  auto shared = std::make_shared<TestNodeConfig>();
  int calls = 0;
  shared->complete_func = [&calls] {
    ++calls;
    return calls == 1 ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  };
  factory.addSubstitutionRule("*/go", shared);
  tell(factory, "a function");
  std::cout << calls << " calls" << std::endl;

  factory.clearSubstitutionRules();
  factory.addSubstitutionRule("nobody", "Pretend");
  factory.loadSubstitutionRuleFromJSON(R"({
    "TestNodeConfigs": {
      "Scripted": {"return_status_script": "count > 0 ? SUCCESS : FAILURE",
                   "failure_script": "result := 'nothing counted'"},
      "Ready": {"return_status": "SUCCESS", "post_script": "count := 1", "async_delay": 1}
    },
    "SubstitutionRules": {"second": "Ready", "home": "Scripted", "first/go": "Pretend"}
  })");
  std::cout << factory.substitutionRules().size() << " rules" << std::endl;
  tell(factory, "from JSON, a SubTree and a script");

  factory.clearSubstitutionRules();
  tell(factory, "no rule again");

  factory.addSubstitutionRule("home", "Nowhere");
  try {
    tell(factory, "a rule that leads nowhere");
  } catch (const RuntimeError& error) {
    std::cout << "RuntimeError" << std::endl;
  }
  for (const char* json : {R"({"TestNodeConfigs": {"A": {}}, "SubstitutionRules": {}})", "{", "[]",
                           R"({"SubstitutionRules": {}})"}) {
    try {
      factory.loadSubstitutionRuleFromJSON(json);
      std::cout << "taken" << std::endl;
    } catch (const std::exception& error) {
      std::cout << "refused" << std::endl;
    }
  }
}
