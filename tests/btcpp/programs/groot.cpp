// A program that shows its tree in Groot2, linked with the compiled functions of the headers. With
// a port it is watched: it goes on at each line of its input (tests/groot/program_test.py).
#include <iostream>
#include <string>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/loggers/groot2_publisher.h"

namespace {

void be_watched(BT::Tree& tree, unsigned port) {
  const BT::Groot2Publisher publisher(tree, port);
  std::string line;
  std::cout << BT::toStr(tree.tickExactlyOnce()) << std::endl;
  std::getline(std::cin, line);
  tree.haltTree();
  std::cout << BT::toStr(tree.rootNode()->status()) << std::endl;
  std::getline(std::cin, line);
}

}  // namespace

int main(int argc, char** argv) {
  BT::BehaviorTreeFactory factory;
  if (argc > 1) {
    auto tree = factory.createTreeFromText(
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence><AlwaysSuccess/>"
        "<Sleep msec=\"1000000\"/></Sequence></BehaviorTree></root>");
    be_watched(tree, static_cast<unsigned>(std::stoul(argv[1])));
    return 0;
  }
  auto tree = factory.createTreeFromText(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><AlwaysSuccess/></BehaviorTree></root>");
  std::cout << BT::toStr(tree.tickWhileRunning()) << std::endl;
  return 0;
}
