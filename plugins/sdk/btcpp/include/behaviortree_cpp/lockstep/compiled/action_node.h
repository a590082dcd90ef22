// The functions of action_node.h. Included by it.
#pragma once

#include <string>
#include <utility>

#include "behaviortree_cpp/action_node.h"

namespace BT {

LOCKSTEP_BTCPP_INLINE ActionNodeBase::ActionNodeBase(const std::string& name,
                                                     const NodeConfig& config)
    : LeafNode(name, config) {}
LOCKSTEP_BTCPP_INLINE ActionNodeBase::~ActionNodeBase() = default;

LOCKSTEP_BTCPP_INLINE SyncActionNode::SyncActionNode(const std::string& name,
                                                     const NodeConfig& config)
    : ActionNodeBase(name, config) {}
LOCKSTEP_BTCPP_INLINE SyncActionNode::~SyncActionNode() = default;

LOCKSTEP_BTCPP_INLINE SimpleActionNode::SimpleActionNode(const std::string& name,
                                                         TickFunctor function,
                                                         const NodeConfig& config)
    : SyncActionNode(name, config), lockstep_function_(std::move(function)) {}
LOCKSTEP_BTCPP_INLINE SimpleActionNode::~SimpleActionNode() = default;
LOCKSTEP_BTCPP_INLINE NodeStatus SimpleActionNode::tick() {
  if (status() == NodeStatus::IDLE) setStatus(NodeStatus::RUNNING);
  return lockstep_function_(*this);
}

LOCKSTEP_BTCPP_INLINE StatefulActionNode::StatefulActionNode(const std::string& name,
                                                             const NodeConfig& config)
    : ActionNodeBase(name, config) {}
LOCKSTEP_BTCPP_INLINE StatefulActionNode::~StatefulActionNode() = default;
LOCKSTEP_BTCPP_INLINE NodeStatus StatefulActionNode::tick() {
  const NodeStatus before = status();
  if (isStatusCompleted(before)) return before;
  return before == NodeStatus::RUNNING ? onRunning() : onStart();
}
LOCKSTEP_BTCPP_INLINE void StatefulActionNode::halt() {
  lockstep_is_halt_requested_ = true;
  if (status() == NodeStatus::RUNNING) onHalted();
  resetStatus();
}

}  // namespace BT
