// A plugin whose registration fails.
#include "behaviortree_cpp/bt_factory.h"

BT_REGISTER_NODES(factory) {
  const auto nothing = [](BT::TreeNode&) { return BT::NodeStatus::SUCCESS; };
  factory.registerSimpleAction("Same", nothing);
  factory.registerSimpleAction("Same", nothing);
}
