// Switch2 to Switch6 in trees: tags, not classes.
#pragma once

#include "behaviortree_cpp/control_node.h"
#include "behaviortree_cpp/lockstep/absent_node.h"

namespace BT {

template <std::size_t kCases>
class SwitchNode : public lockstep_detail::LockstepAbsentNode<ControlNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};

}  // namespace BT
