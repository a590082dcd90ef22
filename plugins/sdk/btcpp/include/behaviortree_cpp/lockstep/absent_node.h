// The nodes of the language that are no classes here: the compiler says so where one is made.
#pragma once

#include <string>

#include "behaviortree_cpp/action_node.h"
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
  void halt() override {}
};

}  // namespace lockstep_detail

class EntryUpdatedAction : public lockstep_detail::LockstepAbsentNode<ActionNodeBase> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class ScriptCondition : public lockstep_detail::LockstepAbsentNode<ActionNodeBase> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class ScriptNode : public lockstep_detail::LockstepAbsentNode<ActionNodeBase> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class SetBlackboardNode : public lockstep_detail::LockstepAbsentNode<ActionNodeBase> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class SleepNode : public lockstep_detail::LockstepAbsentNode<ActionNodeBase> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class UnsetBlackboardNode : public lockstep_detail::LockstepAbsentNode<ActionNodeBase> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class IfThenElseNode : public lockstep_detail::LockstepAbsentNode<ControlNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class ManualSelectorNode : public lockstep_detail::LockstepAbsentNode<ControlNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class ParallelAllNode : public lockstep_detail::LockstepAbsentNode<ControlNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class ParallelNode : public lockstep_detail::LockstepAbsentNode<ControlNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class TryCatchNode : public lockstep_detail::LockstepAbsentNode<ControlNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class WhileDoElseNode : public lockstep_detail::LockstepAbsentNode<ControlNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class DelayNode : public lockstep_detail::LockstepAbsentNode<DecoratorNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class EntryUpdatedDecorator : public lockstep_detail::LockstepAbsentNode<DecoratorNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class PreconditionNode : public lockstep_detail::LockstepAbsentNode<DecoratorNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class SubTreeNode : public lockstep_detail::LockstepAbsentNode<DecoratorNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
class TimeoutNode : public lockstep_detail::LockstepAbsentNode<DecoratorNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};
template <std::size_t kCases>
class SwitchNode : public lockstep_detail::LockstepAbsentNode<ControlNode> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};

}  // namespace BT
