// Values: what Any, conversions, texts, JSON and the declarations of ports give.
#include <iostream>
#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/json_export.h"
using namespace BT;
enum class Color { Red = 1, Green = 2 };
struct Pair {
  double x;
  int n;
};
BT_JSON_CONVERTER(Pair, p) {
  add_field("x", &p.x);
  add_field("n", &p.n);
}
template <class F>
void say(const char* what, F f) {
  std::cout << what << ": ";
  try {
    std::cout << f() << std::endl;
  } catch (const BT::RuntimeError&) {
    std::cout << "RuntimeError" << std::endl;
  } catch (const BT::LogicError&) {
    std::cout << "LogicError" << std::endl;
  } catch (const std::runtime_error&) {
    std::cout << "std::runtime_error" << std::endl;
  } catch (const std::exception&) {
    std::cout << "std::exception" << std::endl;
  }
}
#define SAY(x) say(#x, [&] { return x; })
class Say : public SyncActionNode {
 public:
  Say(const std::string& n, const NodeConfig& c) : SyncActionNode(n, c) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    SAY(Any("5").cast<int>());
    SAY(Any("5").cast<double>());
    SAY(Any("x").cast<int>());
    SAY(Any(5).cast<std::string>());
    SAY(Any(2.5).cast<std::string>());
    SAY(Any(2.5).cast<int>());
    SAY(Any(2.0).cast<int>());
    SAY(Any(300).cast<uint8_t>());
    SAY(Any(-1).cast<unsigned>());
    SAY(Any(true).cast<int>());
    SAY(Any(2).cast<bool>());
    SAY(Any(0.5).cast<bool>());
    SAY(Any(Color::Green).cast<int>());
    SAY(int(Any(2).cast<Color>()));
    SAY(Any().empty());
    SAY(Any(3).isNumber());
    SAY(Any("a").isString());
    SAY(Any(3).isType<int>());
    SAY(Any(3).isType<int64_t>());
    SAY(demangle(Any(3).type()));
    SAY(demangle(Any(3).castedType()));
    SAY(demangle(Any(2.f).type()));
    SAY(demangle(Any("a").type()));
    SAY(Any(Pair{1, 2}).cast<Pair>().n);
    SAY(Any(Pair{1, 2}).cast<int>());
    SAY(Any(3).isIntegral());
    SAY(bool(Any("5").tryCast<int>()));
    SAY(bool(Any("5").tryCast<std::string>()));
    SAY(Any(std::vector<int>{1, 2}).cast<std::vector<int>>().size());
    SAY(Any(Color::Red).isNumber());
    SAY(toStr(3));
    SAY(toStr(2.5));
    SAY(toStr(true));
    SAY(toStr("x"));
    SAY(toStr(std::string("y")));
    SAY(toStr(NodeStatus::SUCCESS));
    SAY(toStr<NodeStatus>(NodeStatus::FAILURE));
    SAY(toStr<bool>(false));
    SAY(toStr(NodeType::ACTION));
    SAY(toStr(PortDirection::INOUT));
    SAY(toStr<NodeType>(NodeType::CONTROL));
    SAY(toStr(std::string_view("view")));
    SAY(toStr(Pair{1.5, 2}));
    RegisterJsonDefinition<Pair>();
    SAY(toStr(Pair{1.5, 2}));
    SAY(toStr(Pair{1, 2}));
    SAY(convertFromString<Pair>("json:{\"x\":1.5,\"n\":3}").n);
    SAY(convertFromString<Pair>("1;2").n);
    SAY(convertFromString<int>("12abc"));
    SAY(convertFromString<int>(" 5"));
    SAY(convertFromString<int>("+5"));
    SAY(convertFromString<int>(""));
    SAY(convertFromString<uint8_t>("256"));
    SAY(convertFromString<unsigned>("-1"));
    SAY(convertFromString<double>("2.5x"));
    SAY(convertFromString<double>("+1"));
    SAY(convertFromString<double>("inf"));
    SAY(convertFromString<double>(".5"));
    SAY(convertFromString<float>("1e3"));
    SAY(convertFromString<bool>("True"));
    SAY(convertFromString<bool>("yes"));
    SAY(convertFromString<bool>("1"));
    SAY(convertFromString<std::vector<int>>("1;2;3;").size());
    SAY(convertFromString<std::vector<double>>("1; 2").size());
    SAY(convertFromString<std::vector<std::string>>("a;b c").at(1));
    SAY(convertFromString<std::vector<bool>>("true;false").size());
    SAY(convertFromString<NodeStatus>("RUNNING"));
    SAY(convertFromString<NodeStatus>("running"));
    SAY(convertFromString<NodeType>("Action"));
    SAY(convertFromString<PortDirection>("INPUT"));
    SAY(convertFromString<Color>("Red") == Color::Red);
    SAY(int(convertFromString<int8_t>("65")));
    SAY(convertFromString<int64_t>("9223372036854775807"));
    SAY(convertFromString<uint64_t>("18446744073709551615"));
    SAY(splitString("a;b;;c;", ';').size());
    SAY(splitString("", ';').size());
    SAY(splitString(";", ';').size());
    SAY(splitString("a", ';').at(0));
    SAY(isStatusActive(NodeStatus::SKIPPED));
    SAY(isStatusCompleted(NodeStatus::FAILURE));
    SAY(NodeStatus::SKIPPED);
    SAY(TreeNode::isBlackboardPointer("{a}"));
    SAY(TreeNode::isBlackboardPointer(" {a} "));
    SAY(TreeNode::isBlackboardPointer("{}"));
    SAY(TreeNode::stripBlackboardPointer(" {a} "));
    SAY(TreeNode::getRemappedKey("p", "{=}").value());
    SAY(bool(TreeNode::getRemappedKey("p", "x")));
    SAY(TreeNode::getRemappedKey("p", "{q}").value());
    SAY(demangle(typeid(std::string)));
    SAY(demangle(typeid(std::vector<std::string>)));
    SAY(demangle(typeid(Pair)));
    SAY(demangle(typeid(Color)));
    SAY(StrCat("a", "b", std::string("c")));
    SAY(std::string(RuntimeError("a", "b", "c").what()));
    SAY(std::string(LogicError("x").what()));
    SAY(Any("5x").cast<int>());
    SAY(Any("2.7").cast<int>());
    SAY(Any("true").cast<bool>());
    SAY(Any("x5").cast<double>());
    SAY(int(Any("2").cast<Color>()));
    SAY(getType<Say>());
    SAY(TypeInfo::Create<int>().typeName());
    SAY(TypeInfo::Create<std::string>().typeName());
    SAY(TypeInfo::Create<AnyTypeAllowed>().isStronglyTyped());
    SAY(TypeInfo::Create<Any>().typeName());
    SAY(TypeInfo().typeName());
    SAY(TypeInfo::Create<int>().parseString("12").cast<int>());
    SAY(InputPort<int>("a", 5, "d").second.defaultValueString());
    SAY(InputPort<std::string>("a", "t", "d").second.defaultValueString());
    SAY(InputPort<bool>("a", true, "d").second.defaultValueString());
    SAY(InputPort<int>("a", "{=}", "d").second.defaultValueString());
    SAY(InputPort<int>("a", "d").second.description());
    SAY(InputPort<int>("a").first);
    SAY(InputPort<int>("_a").first);
    SAY(InputPort<int>("name").first);
    SAY(InputPort<int>("a b").first);
    SAY(InputPort<int>("1a").first);
    SAY(OutputPort<int>("a", "x", "d").first);
    SAY(InputPort<Pair>("a", Pair{1, 2}, "d").second.defaultValueString());
    SAY(InputPort<Color>("a", Color::Red, "d").second.defaultValueString());
    SAY(InputPort<NodeStatus>("a", NodeStatus::SUCCESS, "d").second.defaultValueString());
    SAY(InputPort<std::vector<double>>("a", std::vector<double>{1, 2.5}, "d")
            .second.defaultValueString());
    SAY(InputPort<int>("a").second.direction());
    SAY(BidirectionalPort<int>("a").second.typeName());
    SAY(InputPort("a").second.typeName());
    SAY(name());
    SAY(registrationName());
    SAY(fullPath().empty());
    SAY(type());
    SAY(status());
    SAY(isHalted());
    SAY(config().manifest->registration_ID);
    SAY(config().manifest->ports.size());
    SAY(config().input_ports.size());
    SAY(config().other_attributes.size());
    SAY(config().uid == UID());
    SAY(config().path == fullPath());
    SAY(convertFromJSON<Pair>("{\"x\":1.5,\"n\":3}").n);
    SAY(toJsonString(Any(Pair{1, 2})).value());
    SAY(toJsonString(Any(3)).value());
    SAY(toJsonString(Any("t")).value());
    SAY(toJsonString(Any(2.5)).value());
    SAY(toJsonString(Any(std::vector<Pair>{{1, 2}})).value());
    SAY(toJsonString(Any(std::vector<double>{1, 2})).value());
    SAY(bool(toJsonString(Any(std::pair<int, int>{1, 2}))));
    SAY(IsAllowedPortName("a"));
    SAY(IsAllowedPortName("_a"));
    SAY(IsReservedAttribute("name"));
    SAY(IsReservedAttribute("_skipIf"));
    SAY(IsReservedAttribute("a"));
    {
      Any a(5), b(2.5);
      a.copyInto(b);
      SAY(b.cast<double>());
      SAY(demangle(b.type()));
    }
    {
      Any a("7"), b(2.5);
      say("copy", [&] {
        a.copyInto(b);
        return b.cast<std::string>();
      });
    }
    return NodeStatus::SUCCESS;
  }
};
BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Say>("Say");
}
