// ScriptNode in trees: a tag, not a class.
#pragma once

#include "behaviortree_cpp/action_node.h"
#include "behaviortree_cpp/lockstep/absent_node.h"

namespace BT {

class ScriptNode : public lockstep_detail::LockstepAbsentNode<ActionNodeBase> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};

}  // namespace BT
