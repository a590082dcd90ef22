// DelayNode in trees: a tag, not a class.
#pragma once

#include "behaviortree_cpp/decorator_node.h"
#include "behaviortree_cpp/lockstep/absent_node.h"

namespace BT {

class DelayNode : public detail::AbsentNode<DecoratorNode> {
 public:
  using AbsentNode::AbsentNode;
};

}  // namespace BT
