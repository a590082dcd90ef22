// As the tag ReactiveSequence, for classes that derive from it.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class ReactiveSequence : public detail::ReactiveRowNode {
 public:
  explicit ReactiveSequence(const std::string& name) : ReactiveRowNode(name, NodeStatus::SUCCESS) {}
};

}  // namespace BT
