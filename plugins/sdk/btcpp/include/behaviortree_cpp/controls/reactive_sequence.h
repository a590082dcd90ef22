// As the tag ReactiveSequence.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class ReactiveSequence : public lockstep_detail::LockstepReactiveRowNode {
 public:
  explicit ReactiveSequence(const std::string& name)
      : LockstepReactiveRowNode(name, NodeStatus::SUCCESS) {
    setRegistrationID("ReactiveSequence");
  }
};

}  // namespace BT
