// The functions of condition_node.h. Included by it.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/condition_node.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE ConditionNode::ConditionNode(const std::string& name,
                                                   const NodeConfig& config)
    : LeafNode(name, config) {}
LOCKSTEP_BTCPP_INLINE ConditionNode::~ConditionNode() = default;

LOCKSTEP_BTCPP_INLINE SimpleConditionNode::SimpleConditionNode(const std::string& name,
                                                               TickFunctor function,
                                                               const NodeConfig& config)
    : ConditionNode(name, config), lockstep_function_(std::move(function)) {}
LOCKSTEP_BTCPP_INLINE SimpleConditionNode::~SimpleConditionNode() = default;
LOCKSTEP_BTCPP_INLINE NodeStatus SimpleConditionNode::tick() {
  return lockstep_function_(*this);
}

}  // namespace BT
