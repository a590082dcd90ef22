// Entries by name, and values of ports in place.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"

using namespace BT;

struct Item {
  std::string name;
  int count = 0;
};

class Put : public SyncActionNode {
 public:
  Put(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    auto board = config().blackboard;
    board->set("number", 5);
    board->set("real", 2.5);
    board->set("text", "hello");
    board->set("text", std::string("world"));
    board->set("item", Item{"cup", 3});
    board->set("flag", true);
    board->set("@shared", 1);
    return NodeStatus::SUCCESS;
  }
};

class Look : public SyncActionNode {
 public:
  Look(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override {
    auto board = config().blackboard;
    std::cout << name() << ":";
    int number = 0;
    std::cout << (board->get("number", number) ? " number " : " no number ") << number;
    std::string text = "-";
    std::cout << (board->get("text", text) ? " text " : " no text ") << text;
    Item item;
    std::cout << (board->get("item", item) ? " item " : " no item ") << item.name << item.count;
    int shared = 0;
    std::cout << (board->get("@shared", shared) ? " shared " : " no shared ") << shared;
    try {
      std::cout << " " << board->get<double>("real");
    } catch (const std::exception&) {
      std::cout << " no real";
    }
    try {
      std::cout << " " << board->get<bool>("flag");
    } catch (const std::exception&) {
      std::cout << " no flag";
    }
    std::cout << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Forget : public SyncActionNode {
 public:
  Forget(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<std::string>("key")}; }
  NodeStatus tick() override {
    config().blackboard->unset(getInput<std::string>("key").value());
    return NodeStatus::SUCCESS;
  }
};

class Change : public SyncActionNode {
 public:
  Change(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() {
    return {BidirectionalPort<Item>("item"), BidirectionalPort<int>("number")};
  }
  NodeStatus tick() override {
    if (auto locked = getLockedPortContent("item")) {
      if (auto* item = locked->castPtr<Item>()) {
        item->count += 10;
        std::cout << "changed " << item->name << " " << item->count << std::endl;
      } else if (locked.get()->empty()) {
        locked.assign(Item{"new", 1});
        std::cout << "assigned" << std::endl;
      }
    }
    std::cout << (getLockedPortContent("number") ? "entry" : "no entry") << std::endl;
    return NodeStatus::SUCCESS;
  }
};

class Show : public SyncActionNode {
 public:
  Show(const std::string& name, const NodeConfig& config) : SyncActionNode(name, config) {}
  static PortsList providedPorts() { return {InputPort<Item>("item")}; }
  NodeStatus tick() override {
    const auto item = getInput<Item>("item");
    std::cout << "show " << (item ? item->name : "nothing") << " " << (item ? item->count : 0)
              << std::endl;
    return NodeStatus::SUCCESS;
  }
};

BT_REGISTER_NODES(factory) {
  factory.registerNodeType<Put>("Put");
  factory.registerNodeType<Look>("Look");
  factory.registerNodeType<Forget>("Forget");
  factory.registerNodeType<Change>("Change");
  factory.registerNodeType<Show>("Show");
}
