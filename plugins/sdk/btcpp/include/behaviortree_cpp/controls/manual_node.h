// ManualSelectorNode in trees: a tag, not a class.
#pragma once

#include "behaviortree_cpp/control_node.h"
#include "behaviortree_cpp/lockstep/absent_node.h"

namespace BT {

class ManualSelectorNode : public lockstep_detail::LockstepAbsentNode<ControlNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};

}  // namespace BT
