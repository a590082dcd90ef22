// Enums with names, and types with a text in JSON.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/json_export.h"

using namespace BT;

enum class Color { Red = 1, Green = 2, Blue = 7 };
enum Level { LOW = -1, HIGH = 1 };

namespace shop {
struct Point {
  double x = 0, y = 0;
};
struct Order {
  std::string name;
  int count = 0;
  bool urgent = false;
  Point place;
  std::vector<double> prices;
};
BT_JSON_CONVERTER(Point, point) {
  add_field("x", &point.x);
  add_field("y", &point.y);
}
BT_JSON_CONVERTER(Order, order) {
  add_field("name", &order.name);
  add_field("count", &order.count);
  add_field("urgent", &order.urgent);
  add_field("place", &order.place);
  add_field("prices", &order.prices);
}
}  // namespace shop

class Paint : public SyncActionNode {
 public:
  Paint(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<Color>("color"), InputPort<Level>("level"), OutputPort<Color>("next")};
  }
  NodeStatus tick() override {
    const auto color = getInput<Color>("color");
    const auto level = getInput<Level>("level");
    std::cout << name() << " " << (color ? static_cast<int>(*color) : -99) << " "
              << (level ? static_cast<int>(*level) : -99) << std::endl;
    setOutput("next", Color::Blue);
    return NodeStatus::SUCCESS;
  }
};

class Deliver : public SyncActionNode {
 public:
  Deliver(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {InputPort<shop::Order>("order"), OutputPort<shop::Order>("sent")};
  }
  NodeStatus tick() override {
    auto order = getInput<shop::Order>("order");
    if (!order) return NodeStatus::FAILURE;
    std::cout << order->name << " " << order->count << " " << order->urgent << " " << order->place.x
              << "/" << order->place.y << " " << order->prices.size() << std::endl;
    ++order->count;
    setOutput("sent", order.value());
    return NodeStatus::SUCCESS;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Paint>("Paint");
  factory.registerNodeType<Deliver>("Deliver");
  factory.registerScriptingEnums<Color>();
  factory.registerScriptingEnum("LOW", LOW);
  factory.registerScriptingEnum("HIGH", HIGH);
  RegisterJsonDefinition<shop::Point>();
  RegisterJsonDefinition<shop::Order>();
}
