// A node of the language that is no class here: the compiler says so where one is made.
#pragma once

#include <string>

#include "behaviortree_cpp/tree_node.h"

namespace BT::lockstep_detail {

template <class Base>
class LockstepAbsentNode : public Base {
 public:
  template <class... Arguments>
  explicit LockstepAbsentNode(Arguments&&...) : Base(std::string(), NodeConfig()) {
    static_assert(sizeof...(Arguments) > 1000,
                  "lockstep has this node of the library as a tag, not as a class: write it in the "
                  "tree; for another kind of it, derive from ControlNode, DecoratorNode or an "
                  "action");
  }
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override { return NodeStatus::IDLE; }
  void halt() override {}
};

}  // namespace BT::lockstep_detail
