// As the tag ReactiveFallback.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class ReactiveFallback : public lockstep_detail::LockstepReactiveRowNode {
 public:
  explicit ReactiveFallback(const std::string& name)
      : LockstepReactiveRowNode(name, NodeStatus::FAILURE) {
    setRegistrationID("ReactiveFallback");
  }
};

}  // namespace BT
