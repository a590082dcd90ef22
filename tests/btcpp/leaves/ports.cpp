// Ports of all types: values, defaults, conversions, and what cannot be read.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

enum class Color { Red = 1, Green = 2, Blue = 3 };

struct Pose {
  double x = 0, y = 0;
};

namespace BT {
template <>
inline Pose convertFromString(StringView text) {
  const auto parts = splitString(text, ',');
  if (parts.size() != 2) throw RuntimeError("a pose is two numbers");
  return {convertFromString<double>(parts[0]), convertFromString<double>(parts[1])};
}
template <>
inline Color convertFromString(StringView text) {
  if (text == "red") return Color::Red;
  if (text == "green") return Color::Green;
  if (text == "blue") return Color::Blue;
  throw RuntimeError("no color");
}
}  // namespace BT

std::ostream& operator<<(std::ostream& out, const Pose& pose) {
  return out << pose.x << "/" << pose.y;
}

class Types : public SyncActionNode {
 public:
  Types(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<bool>("flag"),
            InputPort<int>("count", 7, "with a default"),
            InputPort<unsigned>("size", "12", "with a default as a text"),
            InputPort<std::uint8_t>("byte"),
            InputPort<std::int64_t>("big"),
            InputPort<float>("ratio"),
            InputPort<double>("length"),
            InputPort<std::string>("text", "nothing", "with a default"),
            InputPort<std::vector<double>>("numbers"),
            InputPort<std::vector<int>>("counts"),
            InputPort<std::vector<std::string>>("words"),
            InputPort<Color>("color"),
            InputPort<Pose>("pose", Pose{8, 9}, "with a default"),
            InputPort<NodeStatus>("status"),
            InputPort("generic")};
  }

  NodeStatus tick() override {
    std::cout << name() << ":";
    show<bool>("flag");
    show<int>("count");
    show<unsigned>("size");
    show<std::uint8_t, int>("byte");
    show<std::int64_t>("big");
    show<float>("ratio");
    show<double>("length");
    show<std::string>("text");
    list<double>("numbers");
    list<int>("counts");
    list<std::string>("words");
    show<Color, int>("color");
    show<Pose>("pose");
    show<NodeStatus>("status");
    show<std::string>("generic");
    std::cout << std::endl;
    return NodeStatus::SUCCESS;
  }

 private:
  template <class T, class As = T>
  void show(const std::string& port) {
    const auto value = getInput<T>(port);
    std::cout << " " << port << "=";
    if (value) {
      std::cout << static_cast<As>(value.value());
    } else {
      std::cout << "none";
    }
  }
  template <class T>
  void list(const std::string& port) {
    std::vector<T> items;
    std::cout << " " << port << "=";
    if (!getInput(port, items)) std::cout << "none";
    for (const auto& item : items) std::cout << "[" << item << "]";
  }
};

class Write : public SyncActionNode {
 public:
  Write(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {OutputPort<bool>("flag"),
            OutputPort<int>("count"),
            OutputPort<std::uint8_t>("byte"),
            OutputPort<float>("ratio"),
            OutputPort<std::string>("text"),
            OutputPort<std::vector<double>>("numbers"),
            OutputPort<std::vector<std::string>>("words"),
            OutputPort<Color>("color"),
            OutputPort<Pose>("pose"),
            OutputPort("generic"),
            OutputPort<double>("default", "{=}", "an entry by default"),
            BidirectionalPort<int>("counter")};
  }

  NodeStatus tick() override {
    std::cout << name() << ":";
    say(setOutput("flag", true));
    say(setOutput("count", 41));
    say(setOutput("byte", std::uint8_t{200}));
    say(setOutput("ratio", 0.25f));
    say(setOutput("text", "written"));
    say(setOutput("numbers", std::vector<double>{1, 2.5}));
    say(setOutput("words", std::vector<std::string>{"a", "b c"}));
    say(setOutput("color", Color::Blue));
    say(setOutput("pose", Pose{3, 4}));
    say(setOutput("generic", 2.5));
    say(setOutput("default", 0.5));
    const int before = getInput<int>("counter").value_or(100);
    say(setOutput("counter", before + 1));
    std::cout << std::endl;
    return NodeStatus::SUCCESS;
  }

 private:
  static void say(const Result& result) { std::cout << (result ? " ok" : " refused"); }
};

class Raw : public SyncActionNode {
 public:
  Raw(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<int>("literal"), InputPort<int>("entry"), InputPort<int>("left_out")};
  }

  NodeStatus tick() override {
    const auto& ports = config().input_ports;
    std::cout << registrationName() << " " << ports.count("literal") << ports.count("left_out")
              << " " << ports.at("literal") << " " << ports.at("entry") << " "
              << getRawPortValue("literal") << " " << isBlackboardPointer(ports.at("entry"))
              << std::endl;
    return NodeStatus::SUCCESS;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Types>("Types");
  factory.registerNodeType<Write>("Write");
  factory.registerNodeType<Raw>("Raw");
}
