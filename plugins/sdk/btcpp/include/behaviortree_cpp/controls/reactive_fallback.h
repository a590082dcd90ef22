// As the tag ReactiveFallback, for classes that derive from it.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class ReactiveFallback : public lockstep_detail::LockstepReactiveRowNode {
 public:
  explicit ReactiveFallback(const std::string& name)
      : LockstepReactiveRowNode(name, NodeStatus::FAILURE) {}
};

}  // namespace BT
