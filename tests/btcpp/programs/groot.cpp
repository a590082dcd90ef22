// A program that shows its tree in Groot2, linked with the compiled functions of the headers.
#include <iostream>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/loggers/groot2_publisher.h"

int main(int argc, char** /*argv*/) {
  BT::BehaviorTreeFactory factory;
  auto tree = factory.createTreeFromText(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><AlwaysSuccess/></BehaviorTree></root>");
  if (argc > 1) const BT::Groot2Publisher publisher(tree);  // the test needs no port
  std::cout << BT::toStr(tree.tickWhileRunning()) << std::endl;
  return 0;
}
