// EntryUpdatedAction in trees: a tag, not a class.
#pragma once

#include "behaviortree_cpp/action_node.h"
#include "behaviortree_cpp/lockstep/absent_node.h"

namespace BT {

class EntryUpdatedAction : public detail::AbsentNode<ActionNodeBase> {
 public:
  using AbsentNode::AbsentNode;
};

}  // namespace BT
