// A question, asked in every tick.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "behaviortree_cpp/leaf_node.h"

namespace BT {

class ConditionNode : public LeafNode {
 public:
  ConditionNode(const std::string& name, const NodeConfig& config);
  ~ConditionNode() override;
  NodeType type() const final { return NodeType::CONDITION; }
  void halt() final { resetStatus(); }
};

class SimpleConditionNode : public ConditionNode {
 public:
  using TickFunctor = std::function<NodeStatus(TreeNode&)>;
  SimpleConditionNode(const std::string& name, TickFunctor function, const NodeConfig& config);
  ~SimpleConditionNode() override;

 protected:
  NodeStatus tick() override;

 private:
  TickFunctor lockstep_function_;
};

}  // namespace BT

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/condition_node.h"  // IWYU pragma: export
#endif
