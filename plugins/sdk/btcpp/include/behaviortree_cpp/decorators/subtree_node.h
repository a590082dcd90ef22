// SubTreeNode in trees: a tag, not a class.
#pragma once

#include "behaviortree_cpp/decorator_node.h"
#include "behaviortree_cpp/lockstep/absent_node.h"

namespace BT {

class SubTreeNode : public lockstep_detail::LockstepAbsentNode<DecoratorNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};

}  // namespace BT
