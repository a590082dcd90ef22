// As the tag ReactiveFallback, for classes that derive from it.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class ReactiveFallback : public detail::ReactiveRowNode {
 public:
  explicit ReactiveFallback(const std::string& name) : ReactiveRowNode(name, NodeStatus::FAILURE) {}
};

}  // namespace BT
