// All classes of nodes.
#pragma once

#include "behaviortree_cpp/action_node.h"     // IWYU pragma: export
#include "behaviortree_cpp/condition_node.h"  // IWYU pragma: export
#include "behaviortree_cpp/control_node.h"    // IWYU pragma: export
#include "behaviortree_cpp/decorator_node.h"  // IWYU pragma: export
#include "behaviortree_cpp/lockstep/nodes.h"  // IWYU pragma: export
#include "behaviortree_cpp/tree_node.h"       // IWYU pragma: export

namespace BT {

template <class T>
constexpr NodeType getType() {
  if constexpr (std::is_base_of_v<ActionNodeBase, T>) {
    return NodeType::ACTION;
  } else if constexpr (std::is_base_of_v<ConditionNode, T>) {
    return NodeType::CONDITION;
  } else if constexpr (std::is_base_of_v<ControlNode, T>) {
    return NodeType::CONTROL;
  } else if constexpr (std::is_base_of_v<DecoratorNode, T>) {
    return NodeType::DECORATOR;
  } else {
    return NodeType::UNDEFINED;
  }
}

}  // namespace BT
