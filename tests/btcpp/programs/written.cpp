// A program that looks at what its factory and its trees are, and writes them.
#include <iostream>
#include <map>
#include <set>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/xml_parsing.h"

using namespace BT;

class Move : public SyncActionNode {
 public:
  Move(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<int>("x", 3, "where to"), InputPort<double>("speed"),
            OutputPort<int>("reached"), BidirectionalPort<std::string>("note", "{=}", "a <note>")};
  }
  static KeyValueVector metadata() { return {{"team", "arms & legs"}}; }
  NodeStatus tick() override { return NodeStatus::SUCCESS; }
};

static const char* const kTrees = R"(
<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Sequence>
      <Move x="2" reached="{y}" _mark="it" _skipIf="1 &lt; 0"/>
      <Action ID="Move" name="Move" speed="{q}"/>
      <SubTree ID="Part" a="1" b="{c}" _autoremap="true" _mark="part"/>
      <SubTree ID="Part" name="Part"/>
      <SubTree ID="Part" name="it"/>
      <Repeat num_cycles="2" name="again"><AlwaysSuccess name="AlwaysSuccess"/></Repeat>
      <SetBlackboard value="1" output_key="k"/>
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Part">
    <Fallback name="f"><AlwaysSuccess/><SubTree ID="Inner"/></Fallback>
  </BehaviorTree>
  <BehaviorTree ID="Inner"><Move name="deep"/></BehaviorTree>
</root>)";

template <class Map>
void tell_all(const char* what, const Map& map) {
  for (const auto& [key, value] : std::map<std::string, std::string>(map.begin(), map.end())) {
    std::cout << " " << what << ":" << key << "=" << value;
  }
}

static void tell_nodes(const Tree& tree) {
  for (const auto& subtree : tree.subtrees) {
    std::cout << "'" << subtree->instance_name << "' " << subtree->tree_ID << std::endl;
    for (const auto& node : subtree->nodes) {
      const NodeConfig& config = static_cast<const TreeNode*>(node.get())->config();
      std::cout << "  " << node->fullPath() << " " << node->UID() << " " << node->registrationName()
                << " " << toStr(node->type());
      tell_all("in", config.input_ports);
      tell_all("out", config.output_ports);
      tell_all("other", config.other_attributes);
      const bool is_there = config.manifest != nullptr;
      std::cout << (is_there && config.manifest == &tree.manifests.at(node->registrationName())
                        ? " manifest"
                        : "")
                << std::endl;
    }
  }
}

// What a document says, whatever its order and its blanks.
static std::string state_of(Tree tree) {
  std::string text;
  tree.applyVisitor([&text](const TreeNode* node) {
    text += node->registrationName() + " " + node->name() + "\n";
  });
  return text;
}

int main() {
  BehaviorTreeFactory factory;
  factory.registerNodeType<Move>("Move");
  Tree tree = factory.createTreeFromText(kTrees);
  tell_nodes(tree);
  for (const std::string& id : factory.registeredBehaviorTrees()) std::cout << id << std::endl;

  int count = 0;
  applyRecursiveVisitor(tree.rootNode(), [&count](const TreeNode*) { ++count; });
  std::cout << count << " nodes" << std::endl;
  tree.tickOnce();
  SerializedTreeStatus statuses;
  buildSerializedStatusSnapshot(tree.rootNode(), statuses);
  std::cout << statuses.size() << " statuses" << std::endl;

  // The models are those of the nodes, and load again.
  const std::string models = writeTreeNodesModelXML(factory);
  for (const char* part : {"<Action ID=\"Move\">", "name=\"x\"", "default=\"3\"", "type=\"double\"",
                           "a &lt;note&gt;", "<Metadata team=\"arms &amp; legs\"/>"}) {
    if (models.find(part) == std::string::npos) std::cout << "no " << part << models << std::endl;
  }
  BehaviorTreeFactory other;
  other.registerNodeType<Move>("Move");
  other.registerBehaviorTreeFromText(models);
  if (writeTreeNodesModelXML(factory, true).find("ID=\"Repeat\"") == std::string::npos) {
    std::cout << "no model of Repeat" << std::endl;
  }
  std::cout << "models of all nodes: " << factory.manifests().size() << std::endl;
  for (const std::string& id : factory.builtinNodes()) {
    if (factory.manifests().count(id) == 0) std::cout << "no manifest of " << id << std::endl;
  }
  const std::string schema = writeTreeXSD(factory);
  for (const char* part : {"\"Move\"", "\"Sequence\"", "\"SubTree\"", "BehaviorTree"}) {
    if (schema.find(part) == std::string::npos) std::cout << "no " << part << std::endl;
  }

  // So does a tree.
  XMLParser parser(other);
  parser.loadFromText(R"(<root BTCPP_format="4">
    <BehaviorTree ID="B"><Sequence name="s"><Move name="m" x="4"/></Sequence></BehaviorTree></root>)");
  const Tree small = parser.instantiateTree(Blackboard::create());
  const std::string written = WriteTreeToXML(small, false, false);
  parser.clearInternalState();
  parser.loadFromText(written);
  std::cout << state_of(parser.instantiateTree(Blackboard::create()))
            << parser.registeredBehaviorTrees().size() << " tree" << std::endl;
  const std::string with_numbers = WriteTreeToXML(tree, true, false);
  for (const char* part : {"_fullpath=\"Part::4/Inner::7\"", "_uid=\"20\"", "_fullpath=\"it\""}) {
    if (with_numbers.find(part) == std::string::npos) std::cout << "no " << part << std::endl;
  }

  parser.loadFromText(R"(<root BTCPP_format="4">
    <BehaviorTree ID="A"><AlwaysFailure/></BehaviorTree></root>)");
  for (const std::string& id : parser.registeredBehaviorTrees()) std::cout << id << std::endl;
  std::cout << toStr(parser.instantiateTree(Blackboard::create(), "A").tickOnce()) << std::endl;
  std::cout << LibraryVersionString() << " " << LibraryVersionNumber() << std::endl;

  const Expected<int> five = 5;
  const Expected<int> none = nonstd::make_unexpected(std::string("why"));
  std::cout << (five == 5) << (five != 5) << (5 == five) << (none == 5) << (five == five)
            << (five == none) << (none != five) << std::endl;
}
