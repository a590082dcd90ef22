// Objects go by reference between a program and a plugin that have no port of their types.
#include "btcpp/leaves/driver.h"

#include <filesystem>
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"

int main() {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  BT::BehaviorTreeFactory factory;
  factory.registerFromPlugin((folder / "driver.so").string());
  const auto board = BT::Blackboard::create();
  const auto driver = std::make_shared<Driver>(Driver{"arm"});
  board->set("driver", driver);
  const std::string text =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Use/></BehaviorTree></root>";
  auto tree = factory.createTreeFromText(text, board);
  tree.tickOnce();
  tree.tickOnce();
  std::cout << driver->used << ' ' << board->get<Way>("way").length << std::endl;
  try {
    auto without = factory.createTreeFromText(text);
  } catch (const std::exception&) {
    std::cout << "no driver" << std::endl;
  }
  return 0;
}
