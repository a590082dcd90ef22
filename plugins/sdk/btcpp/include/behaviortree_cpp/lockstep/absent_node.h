// The classes of the library that are none here: the compiler says so where one is made.
#pragma once

#include <string>

#include "behaviortree_cpp/action_node.h"
#include "behaviortree_cpp/condition_node.h"
#include "behaviortree_cpp/control_node.h"
#include "behaviortree_cpp/decorator_node.h"

namespace BT {
namespace lockstep_detail {

template <class Base>
class LockstepAbsentNode : public Base {
 public:
  template <class... Arguments>
  explicit LockstepAbsentNode(Arguments&&...) : Base(std::string(), NodeConfig()) {
    static_assert(sizeof...(Arguments) > 1000,
                  "lockstep has this node of the library as a tag, not as a class: write it in the "
                  "tree; for another kind of it, derive from ControlNode, DecoratorNode or an "
                  "action");
  }
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override { return NodeStatus::IDLE; }
};

// It waits for the keys of a terminal.
template <class Base>
class LockstepNoTerminalNode : public Base {
 public:
  template <class... Arguments>
  explicit LockstepNoTerminalNode(Arguments&&...) : Base(std::string(), NodeConfig()) {
    static_assert(sizeof...(Arguments) > 1000,
                  "lockstep has no ManualSelector: a tick must not wait for a terminal; use a "
                  "Switch over an entry that your program sets");
  }
  static PortsList providedPorts() { return {}; }
  NodeStatus tick() override { return NodeStatus::IDLE; }
};

}  // namespace lockstep_detail

class ScriptCondition : public lockstep_detail::LockstepAbsentNode<ConditionNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class ScriptNode : public lockstep_detail::LockstepAbsentNode<SyncActionNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class PreconditionNode : public lockstep_detail::LockstepAbsentNode<DecoratorNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class ManualSelectorNode : public lockstep_detail::LockstepNoTerminalNode<ControlNode> {
 public:
  using LockstepNoTerminalNode::LockstepNoTerminalNode;
};

}  // namespace BT
