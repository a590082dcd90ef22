// Of what kind the values of entries are: what scripts, leaves, SetBlackboard and Switch make of
// numbers and texts.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

static std::string shown(const Any& value) {
  if (value.empty()) return "-";
  const std::string kind = value.isString()                       ? "text "
                           : value.castedType() == typeid(double) ? "real "
                                                                  : "whole ";
  return kind + value.cast<std::string>();
}

class Dump : public SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    for (const std::string key : {"a", "b"}) {
      const auto value = config().blackboard->getAnyLocked(key);
      std::cout << "  " << key << " " << (value ? shown(*value.get()) : "-");
    }
    std::cout << std::endl;
    return NodeStatus::SUCCESS;
  }
};

template <class T>
class Out : public SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() { return {OutputPort<T>("out"), InputPort<std::string>("v")}; }
  NodeStatus tick() override {
    const auto text = getInput<std::string>("v").value();
    setOutput("out", convertFromString<T>(text));
    return NodeStatus::SUCCESS;
  }
};

template <class T>
class In : public SyncActionNode {
 public:
  using SyncActionNode::SyncActionNode;
  static PortsList providedPorts() { return {InputPort<T>("in")}; }
  NodeStatus tick() override {
    const auto value = getInput<T>("in");
    std::cout << "  in ";
    if (value) std::cout << *value;
    std::cout << std::endl;
    return NodeStatus::SUCCESS;
  }
};

template <class T>
static void add(BehaviorTreeFactory& factory, const std::string& type) {
  factory.registerNodeType<Out<T>>("Out_" + type);
  factory.registerNodeType<In<T>>("In_" + type);
}

static const char* const kTrees[] = {
    R"(<Script code="a:=3"/><Dump/><Out_double out="{a}" v="2.5"/>)",
    R"(<Script code="a:=2.5"/><Dump/><Out_int out="{a}" v="2"/>)",
    R"(<Script code="a:=2.5"/><Dump/><Out_bool out="{a}" v="1"/>)",
    R"(<Script code="a:=3"/><Dump/><Out_bool out="{a}" v="1"/><Script code="a:=7"/>)",
    R"(<Out_bool out="{a}" v="1"/><Script code="a:=2.0"/><Dump/><Out_bool out="{a}" v="0"/>)",
    R"(<Out_int out="{a}" v="7"/><Script code="b:='5'"/><Dump/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_int out="{a}" v="7"/><Script code="b:='x'"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_int out="{a}" v="7"/><Script code="b:=2.0"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_int out="{a}" v="7"/><Script code="b:=2.5"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_int out="{a}" v="7"/><Out_double out="{b}" v="2.5"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_int out="{a}" v="7"/><Out_double out="{b}" v="2"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_double out="{a}" v="7"/><Out_int out="{b}" v="2"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_string out="{a}" v="7"/><Out_int out="{b}" v="2"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_int out="{a}" v="7"/><Out_string out="{b}" v="2"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_int out="{a}" v="7"/><Out_string out="{b}" v="x"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_int in="{a}"/><Out_string out="{b}" v="2"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_int in="{a}"/><Out_string out="{b}" v="x"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_int in="{a}"/><Out_double out="{b}" v="2"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_int in="{a}"/><Out_double out="{b}" v="2.5"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_double in="{a}"/><Out_int out="{b}" v="2"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_string in="{a}"/><Out_int out="{b}" v="2"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Script code="a:=1"/><Out_int out="{b}" v="2"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Script code="a:=1"/><Out_double out="{b}" v="2.5"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Script code="a:='x'"/><Out_double out="{b}" v="2.5"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_double out="{b}" v="2.5"/><SetBlackboard output_key="a" value="{b}"/><Script code="a:='7'"/>)",
    R"(<Out_string out="{b}" v="2.5"/><SetBlackboard output_key="a" value="{b}"/><Script code="a:=7"/>)",
    R"(<Script code="b:=3"/><SetBlackboard output_key="a" value="{b}"/><Script code="a:=7"/>)",
    R"(<Out_int out="{a}" v="7"/><SetBlackboard output_key="a" value="8"/>)",
    R"(<Out_int out="{a}" v="7"/><SetBlackboard output_key="a" value="8.5"/>)",
    R"(<Out_double out="{a}" v="7"/><SetBlackboard output_key="a" value="8.5"/>)",
    R"(<In_double in="{a}"/><SetBlackboard output_key="a" value="8"/>)",
    R"(<In_double in="{a}"/><Script code="a:=3"/><SetBlackboard output_key="a" value="8"/>)",
    R"(<In_int in="{a}"/><Script code="a:=3.0"/><Dump/><SetBlackboard output_key="a" value="8"/>)",
    R"(<In_int in="{a}"/><Script code="a:='9'"/><Dump/><Script code="a:='x'"/>)",
    R"(<In_bool in="{a}"/><Script code="a:='true'"/><Dump/><Script code="a:=1"/><Dump/><In_string in="{a}"/>)",
    R"(<In_bool in="{a}"/><Script code="a:=true"/><Dump/><In_bool in="{a}"/>)",
    R"(<In_int in="{a}"/><Script code="a:=3.7"/><Dump/><In_int in="{a}"/>)",
    R"(<In_string in="{a}"/><Script code="a:=3"/><Dump/><In_string in="{a}"/><Script code="a:='x'"/>)",
    R"(<Out_string out="{a}" v="x"/><Script code="a:=3"/>)",
    R"(<Out_int out="{a}" v="3"/><Script code="a:='4'"/><Dump/><Script code="a:=4.5"/>)",
    R"(<Script code="a:=1"/><Switch2 variable="{a}" case_1="1" case_2="1.000000"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Script code="a:=true"/><Switch2 variable="{a}" case_1="true" case_2="1"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Script code="a:=RED"/><Switch2 variable="{a}" case_1="GREEN" case_2="RED"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Script code="a:='RED'"/><Switch2 variable="{a}" case_1="1" case_2="RED"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Script code="a:='RED'"/><Switch2 variable="{a}" case_1="1.0" case_2="2"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Out_int out="{a}" v="5"/><Switch2 variable="{a}" case_1="RED" case_2="BLUE"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Script code="a:='5'"/><Switch2 variable="{a}" case_1="RED" case_2="BLUE"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Script code="a:='BLUE'"/><Switch2 variable="{a}" case_1="RED" case_2="5"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Script code="a:=5.0"/><Switch2 variable="{a}" case_1="RED" case_2="BLUE"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Switch2 variable="BLUE" case_1="RED" case_2="5"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Script code="a:=' 5'"/><Switch2 variable="{a}" case_1="5" case_2="BLUE"><Say/><Say2/><AlwaysSuccess/></Switch2>)",
    R"(<Out_double out="{a}" v="7"/><Script code="b:=3"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_double out="{a}" v="7"/><Script code="b:=3.5"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_string out="{a}" v="7"/><Script code="b:=3"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_string out="{a}" v="7"/><Script code="b:='y'"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_double in="{a}"/><Script code="b:=3"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_double in="{a}"/><Script code="b:=3.5"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_string in="{a}"/><Script code="b:=3"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_string in="{a}"/><Script code="b:='z'"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_bool in="{a}"/><Script code="b:='true'"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<In_bool in="{a}"/><Script code="b:=true"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Out_bool out="{a}" v="1"/><Script code="b:=true"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Script code="a:=3"/><Script code="b:=3.5"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Script code="a:='x'"/><Script code="b:=3.5"/><SetBlackboard output_key="a" value="{b}"/><Script code="a:='z'"/>)",
    R"(<Script code="a:=3.5"/><Out_int out="{b}" v="3"/><SetBlackboard output_key="a" value="{b}"/><Dump/><Script code="a:=2.5"/>)",
    R"(<Script code="a:='x'"/><Out_int out="{b}" v="3"/><SetBlackboard output_key="a" value="{b}"/><Dump/><Script code="a:='y'"/>)",
    R"(<Out_int out="{a}" v="7"/><Out_int out="{b}" v="8"/><SetBlackboard output_key="a" value="{b}"/>)",
    R"(<Script code="b:=3"/><SetBlackboard output_key="a" value="{b}"/><Dump/><Out_double out="{a}" v="2.5"/>)",
    R"(<In_int in="{b}"/><SetBlackboard output_key="a" value="{b}"/><Dump/><Script code="a:='x'"/>)",
    R"(<Script code="a:=3"/><Script code="a='x'"/>)",
    R"(<Script code="a:=3"/><Out_string out="{a}" v="x"/>)",
    R"(<Script code="a:='x'"/><Out_int out="{a}" v="3"/><Script code="a:='y'"/>)",
    R"(<Out_int out="{a}" v="3"/><Script code="a:=4.0"/><Dump/><Out_int out="{a}" v="5"/>)",
    R"(<Script code="a:=3"/><Dump/><Out_float out="{a}" v="2"/>)",
    R"(<Script code="a:=true"/><Dump/><Out_bool out="{a}" v="0"/>)",
    R"(<Script code="a:=3.5"/><Dump/><Out_uint out="{a}" v="9"/><In_uint in="{a}"/>)",
    R"(<Script code="a := 1; a := '2.5'"/>)",
    R"(<Script code="a := 1; a := '2'"/>)",
    R"(<Script code="a := 1; a := 'true'"/>)",
    R"(<Script code="a := 1.0; a := '2'"/>)",
    R"(<Script code="a := 0X1F"/>)",
    R"(<Script code="a := 3 &amp; 9007199254740992"/>)",
    R"(<Script code="a := 1; a /= 2"/>)",
    R"(<UnsetBlackboard key="b"/><SetBlackboard output_key="a" value="{b}"/>)",
};

static NodeStatus say(const char* what) {
  std::cout << "  " << what << std::endl;
  return NodeStatus::SUCCESS;
}

int main() {
  for (const std::string nodes : kTrees) {
    BehaviorTreeFactory factory;
    factory.registerNodeType<Dump>("Dump");
    add<int>(factory, "int");
    add<unsigned>(factory, "uint");
    add<double>(factory, "double");
    add<float>(factory, "float");
    add<bool>(factory, "bool");
    add<std::string>(factory, "string");
    factory.registerSimpleAction("Say", [](TreeNode&) { return say("first"); });
    factory.registerSimpleAction("Say2", [](TreeNode&) { return say("second"); });
    factory.registerScriptingEnum("RED", 1);
    factory.registerScriptingEnum("GREEN", 2);
    factory.registerScriptingEnum("BLUE", 5);
    std::cout << nodes << std::endl;
    try {
      auto tree = factory.createTreeFromText(
          "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence>" + nodes +
          "<Dump/></Sequence></BehaviorTree></root>");
      const NodeStatus status = tree.tickWhileRunning();
      std::cout << "  " << toStr(status) << std::endl;
    } catch (const std::exception&) {
      std::cout << "  error" << std::endl;
    }
  }
  return 0;
}
