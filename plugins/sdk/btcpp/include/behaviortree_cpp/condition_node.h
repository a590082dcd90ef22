// A question, asked in every tick.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "behaviortree_cpp/leaf_node.h"

namespace BT {

class ConditionNode : public LeafNode {
 public:
  ConditionNode(const std::string& name, const NodeConfig& config) : LeafNode(name, config) {}
  NodeType type() const final { return NodeType::CONDITION; }
  void halt() final { resetStatus(); }
};

class SimpleConditionNode : public ConditionNode {
 public:
  using TickFunctor = std::function<NodeStatus(TreeNode&)>;
  SimpleConditionNode(const std::string& name, TickFunctor function, const NodeConfig& config)
      : ConditionNode(name, config), lockstep_function_(std::move(function)) {}

 protected:
  NodeStatus tick() override { return lockstep_function_(*this); }

 private:
  TickFunctor lockstep_function_;
};

}  // namespace BT
