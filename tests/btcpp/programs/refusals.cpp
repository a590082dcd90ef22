// A program whose trees have mistakes: each is refused, with the exception that the library throws.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/xml_parsing.h"

using namespace BT;

enum class Color { Red, Blue };

class Paint : public SyncActionNode {
 public:
  Paint(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<int>("layers", 1, "how many"), InputPort<Color>("color"),
            InputPort<std::vector<double>>("shape")};
  }
  NodeStatus tick() override {
    std::cout << name() << ": " << getInput<int>("layers").value() << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Wrong : public SyncActionNode {
 public:
  Wrong(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<int>("name")}; }
  NodeStatus tick() override { return NodeStatus::SUCCESS; }
};

template <class Function>
void tell(const std::string& what, const Function& function) {
  std::cout << what << ": ";
  try {
    function();
    std::cout << "taken";
  } catch (const RuntimeError& error) {
    std::cout << "RuntimeError";
  } catch (const LogicError& error) {
    std::cout << "LogicError";
  } catch (const BehaviorTreeException& error) {
    std::cout << "BehaviorTreeException";
  } catch (const std::runtime_error& error) {
    std::cout << "std::runtime_error";
  } catch (const std::exception& error) {
    std::cout << "std::exception";
  }
  std::cout << std::endl;
}

static std::string document(const std::string& inside) {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\">" + inside + "</root>";
}
static std::string main_tree(const std::string& inside) {
  return document("<BehaviorTree ID=\"Main\">" + inside + "</BehaviorTree>");
}
static std::string other_tree(const std::string& id, const std::string& inside) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"" + id + "\">" + inside +
         "</BehaviorTree></root>";
}
static const std::string kPart = "<BehaviorTree ID=\"Part\"><AlwaysSuccess/></BehaviorTree>";

static void tell_documents(BehaviorTreeFactory& factory) {
  const std::string good = "<AlwaysSuccess/>";
  const std::pair<std::string, std::string> documents[] = {
      {"a good tree", main_tree(good)},
      {"blanks and points in a name", main_tree("<AlwaysSuccess name=\"a b.c/d\"/>")},
      {"an ID with a blank", other_tree("My Main", good)},
      {"an ID with a slash", other_tree("a/b", good)},
      {"the ID Root", other_tree("Root", good)},
      {"an ID beyond ASCII", other_tree("Tür", good)},
      {"another root", "<trees BTCPP_format=\"4\"/>"},
      {"an empty tree", main_tree("")},
      {"two nodes in a tree", main_tree(good + good)},
      {"a node that is not there", main_tree("<Sand/>")},
      {"a decorator without a child", main_tree("<Inverter/>")},
      {"a decorator with two", main_tree("<Inverter>" + good + good + "</Inverter>")},
      {"a Sequence without children", main_tree("<Sequence/>")},
      {"a leaf with a child", main_tree("<Action ID=\"Paint\">" + good + "</Action>")},
      {"a leaf without an ID", main_tree("<Action name=\"it\"/>")},
      {"a tree that is called like a node",
       document("<BehaviorTree ID=\"Main\">" + good + "</BehaviorTree><BehaviorTree ID=\"Paint\">" +
                good + "</BehaviorTree>")},
      {"a SubTree with a blank in its ID", main_tree("<SubTree ID=\"a b\"/>")},
      {"a SubTree that is not there", main_tree("<SubTree ID=\"Nowhere\"/>")},
      {"a tree that contains itself", main_tree("<SubTree ID=\"Main\"/>")},
      {"two SubTrees of one name",
       document("<BehaviorTree ID=\"Main\"><Sequence><SubTree ID=\"Part\" name=\"it\"/><SubTree "
                "ID=\"Part\" name=\"it\"/></Sequence></BehaviorTree>" +
                kPart)},
      {"two SubTrees without a name",
       document("<BehaviorTree ID=\"Main\"><Sequence><SubTree ID=\"Part\"/><SubTree "
                "ID=\"Part\"/></Sequence></BehaviorTree>" +
                kPart)},
      {"a model of a SubTree without an ID",
       document("<BehaviorTree ID=\"Main\">" + good +
                "</BehaviorTree><TreeNodesModel><SubTree/></TreeNodesModel>")},
      {"a port of a SubTree called ID",
       document("<BehaviorTree ID=\"Main\">" + good +
                "</BehaviorTree><TreeNodesModel><SubTree ID=\"Part\"><input_port "
                "name=\"ID\"/></SubTree></TreeNodesModel>")},
      {"a port of a SubTree that begins with a digit",
       document("<BehaviorTree ID=\"Main\">" + good +
                "</BehaviorTree><TreeNodesModel><SubTree ID=\"Part\"><input_port "
                "name=\"1st\"/></SubTree></TreeNodesModel>")},
      {"a port of a SubTree that begins with _",
       document("<BehaviorTree ID=\"Main\">" + good +
                "</BehaviorTree><TreeNodesModel><SubTree ID=\"Part\"><input_port "
                "name=\"__shared_blackboard\" default=\"false\"/></SubTree></TreeNodesModel>")},
      {"models of nodes without an ID",
       document("<BehaviorTree ID=\"Main\">" + good +
                "</BehaviorTree><TreeNodesModel><Condition name=\"Seen\"/><Action/>"
                "</TreeNodesModel>")},
      {"the explicit form below a ReactiveSequence",
       main_tree("<ReactiveSequence><Action ID=\"Paint\"/></ReactiveSequence>")},
      {"two asynchronous children of a ReactiveSequence",
       main_tree("<ReactiveSequence><AsyncSequence>" + good + "</AsyncSequence><AsyncSequence>" +
                 good + "</AsyncSequence></ReactiveSequence>")},
      {"a port that the node lacks", main_tree("<Paint depth=\"3\"/>")},
      {"an attribute that is no port", main_tree("<Paint _depth=\"3\"/>")},
      {"a constant that is no number", main_tree("<Paint layers=\"many\"/>")},
      {"a list with a word in it", main_tree("<Paint shape=\"1;two\"/>")},
      {"a word of an enum", main_tree("<Paint color=\"Blue\"/>")},
      {"a number of an enum", main_tree("<Paint color=\"1\"/>")},
      {"what is no XML", "<root BTCPP_format=\"4\">"},
  };
  for (const auto& [what, text] : documents) {
    tell(what, [&factory, &xml = text] { static_cast<void>(factory.createTreeFromText(xml)); });
  }
}

int main() {
  BehaviorTreeFactory factory;
  factory.registerNodeType<Paint>("Paint");
  factory.registerScriptingEnums<Color>();
  tell_documents(factory);

  tell("an ID twice", [&] { factory.registerNodeType<Paint>("Paint"); });
  tell("a port called name", [&] { factory.registerNodeType<Wrong>("Wrong"); });
  tell("to remove a node of the library", [&] { factory.unregisterBuilder("Sequence"); });
  tell("a file that is not there", [&] { factory.registerBehaviorTreeFromFile("/nowhere.xml"); });
  tell("a plugin that is not there", [&] { factory.registerFromPlugin("/nowhere.so"); });
  tell("metadata of no node", [&] { factory.addMetadataToManifest("Sand", {}); });
  tell("a tree that is not registered", [&] { static_cast<void>(factory.createTree("Nowhere")); });

  // A document that is refused leaves nothing behind.
  tell("a bad one is registered", [&] {
    factory.registerBehaviorTreeFromText("<root BTCPP_format=\"4\">" + kPart +
                                         "<BehaviorTree ID=\"a b\"/></root>");
  });
  std::cout << factory.registeredBehaviorTrees().size() << " trees" << std::endl;
  factory.registerBehaviorTreeFromText("<root BTCPP_format=\"4\">" + kPart + "</root>");
  std::cout << factory.registeredBehaviorTrees().size() << " tree" << std::endl;
  factory.clearRegisteredBehaviorTrees();
  std::cout << factory.registeredBehaviorTrees().size() << " trees" << std::endl;

  // A tree goes on with the nodes that it has.
  Tree tree = factory.createTreeFromText(main_tree("<Paint name=\"wall\" layers=\"2\"/>"));
  std::cout << factory.unregisterBuilder("Paint") << factory.unregisterBuilder("Paint")
            << std::endl;
  std::cout << toStr(tree.tickWhileRunning()) << std::endl;
  tell("a node that was removed",
       [&] { static_cast<void>(factory.createTreeFromText(main_tree("<Paint/>"))); });

  const std::unordered_map<std::string, NodeType> known{{"Sequence", NodeType::CONTROL},
                                                        {"Sand", NodeType::ACTION}};
  tell("VerifyXML with what it knows",
       [&] { VerifyXML(main_tree("<Sequence><Sand/></Sequence>"), known); });
  tell("VerifyXML with another node",
       [&] { VerifyXML(main_tree("<Sequence><Paint/></Sequence>"), known); });
}
