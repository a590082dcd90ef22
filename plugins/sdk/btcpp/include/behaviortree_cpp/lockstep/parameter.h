// A port that a node of the library reads in each tick, as it says what is wrong with it.
#pragma once

#include <string>

#include "behaviortree_cpp/tree_node.h"

namespace BT::lockstep_detail {

template <class T>
T parameter(const TreeNode& node, const char* port) {
  auto value = node.getInput<T>(port);
  if (!value) throw RuntimeError("node '" + node.name() + "': " + value.error());
  return std::move(*value);
}

}  // namespace BT::lockstep_detail
