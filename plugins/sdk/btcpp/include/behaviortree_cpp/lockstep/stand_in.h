// Objects for the nodes of a tree that are none of the program's: of the language, or of a plugin.
// Those of the language are of the library's classes, so that a program finds them by a cast. They
// show what the tree does, and do nothing themselves. Included by program.h.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "behaviortree_cpp/behavior_tree.h"
#include "behaviortree_cpp/lockstep/program_nodes.h"

namespace BT::lockstep_detail {

class Program;
NodeStatus status_in(const Program& program, std::uint32_t index);
NodeStatus tick_root(Program& program);

class StandsIn {
 public:
  virtual ~StandsIn() = default;
  // The next of its children.
  virtual void adopt(TreeNode& child) = 0;
};

// Stands for nodes without a class in the library's headers.
template <class Base>
class Other : public Base {
 public:
  Other(const std::string& name, const NodeConfig& config) : Base(name, config) {}
  NodeStatus tick() override { return NodeStatus::IDLE; }
};
class OtherAction : public Other<ActionNodeBase> {
 public:
  using Other::Other;
  void halt() override { resetStatus(); }
};
template <class Base>
class StandIn final : public Base, public StandsIn {
 public:
  StandIn(Program& program, std::uint32_t index, const NodePlace& place)
      : StandIn(program, index, place, config_of(place)) {}

  // The root: one tick of the tree.
  NodeStatus executeTick() override {
    if (index_ == 0) return tick_root(program_);
    throw LogicError("node '", this->name(), "' is ticked by its tree only: BT::Tree::tickOnce()");
  }
  void adopt(TreeNode& child) override {
    if constexpr (std::is_base_of_v<ControlNode, Base>) {
      this->children_nodes_.push_back(&child);
    } else if constexpr (std::is_base_of_v<DecoratorNode, Base>) {
      this->child_node_ = &child;
    }
  }

 private:
  static constexpr bool kTakesConfig =
      std::is_constructible_v<Base, const std::string&, const NodeConfig&>;
  static constexpr bool kTakesAsync =
      std::is_constructible_v<Base, const std::string&, bool, const NodeConfig&>;

  struct Given {
    const std::string& name;
    const NodeConfig& config;
    bool is_async;
  };
  StandIn(Program& program, std::uint32_t index, const NodePlace& place, const NodeConfig& config)
      : StandIn(program, index, Given{place.name, config, StartWith(place.id, "Async")},
                std::integral_constant < int,
                kTakesConfig  ? 0
                : kTakesAsync ? 1
                              : 2 > ()) {
    this->config() = config;
    this->setRegistrationID(place.number.is_read ? place.number.id : place.id);
  }
  StandIn(Program& program, std::uint32_t index, const Given& given,
          std::integral_constant<int, 0> /*takes a config*/)
      : Base(given.name, given.config), program_(program), index_(index) {}
  StandIn(Program& program, std::uint32_t index, const Given& given,
          std::integral_constant<int, 1> /*takes a flag and a config*/)
      : Base(given.name, given.is_async, given.config), program_(program), index_(index) {}
  StandIn(Program& program, std::uint32_t index, const Given& given,
          std::integral_constant<int, 2> /*takes neither*/)
      : Base(given.name), program_(program), index_(index) {}

  static NodeConfig config_of(const NodePlace& place) {
    NodeConfig config;
    config.path = place.number.path;
    config.uid = place.number.uid;
    config.input_ports = place.number.input_ports;
    config.output_ports = place.number.output_ports;
    config.other_attributes = place.number.other_attributes;
    config.manifest = place.number.manifest;
    return config;
  }
  NodeStatus tick() override { return executeTick(); }
  NodeStatus lockstep_shown_status() const override { return status_in(program_, index_); }
  void lockstep_forget_status() override {}

  Program& program_;
  std::uint32_t index_;
};

using StandInMaker = TreeNode::Ptr (*)(Program&, std::uint32_t, const NodePlace&);

template <class Base>
TreeNode::Ptr stand_in(Program& program, std::uint32_t index, const NodePlace& place) {
  return std::make_shared<StandIn<Base>>(program, index, place);
}

// The class of a node of the language, by its ID; null: the library's headers name none.
inline StandInMaker class_of(const std::string& id) {
  static const std::map<std::string, StandInMaker> makers{
      {"AlwaysFailure", stand_in<AlwaysFailureNode>},
      {"AlwaysSuccess", stand_in<AlwaysSuccessNode>},
      {"AsyncFallback", stand_in<FallbackNode>},
      {"AsyncSequence", stand_in<SequenceNode>},
      {"Delay", stand_in<DelayNode>},
      {"Fallback", stand_in<FallbackNode>},
      {"ForceFailure", stand_in<ForceFailureNode>},
      {"ForceSuccess", stand_in<ForceSuccessNode>},
      {"IfThenElse", stand_in<IfThenElseNode>},
      {"Inverter", stand_in<InverterNode>},
      {"KeepRunningUntilFailure", stand_in<KeepRunningUntilFailureNode>},
      {"LoopBool", stand_in<LoopNode<bool>>},
      {"LoopDouble", stand_in<LoopNode<double>>},
      {"LoopInt", stand_in<LoopNode<int>>},
      {"LoopString", stand_in<LoopNode<std::string>>},
      {"Parallel", stand_in<ParallelNode>},
      {"ParallelAll", stand_in<ParallelAllNode>},
      {"ReactiveFallback", stand_in<ReactiveFallback>},
      {"ReactiveSequence", stand_in<ReactiveSequence>},
      {"Repeat", stand_in<RepeatNode>},
      {"RetryUntilSuccessful", stand_in<RetryNode>},
      {"RunOnce", stand_in<RunOnceNode>},
      {"Sequence", stand_in<SequenceNode>},
      {"SequenceWithMemory", stand_in<SequenceWithMemory>},
      {"SetBlackboard", stand_in<SetBlackboardNode>},
      {"SubTree", stand_in<SubTreeNode>},
      {"Switch2", stand_in<SwitchNode<2>>},
      {"Switch3", stand_in<SwitchNode<3>>},
      {"Switch4", stand_in<SwitchNode<4>>},
      {"Switch5", stand_in<SwitchNode<5>>},
      {"Switch6", stand_in<SwitchNode<6>>},
      {"Timeout", stand_in<TimeoutNode>},
      {"TryCatch", stand_in<TryCatchNode>},
      {"UnsetBlackboard", stand_in<UnsetBlackboardNode>},
      {"WhileDoElse", stand_in<WhileDoElseNode>},
  };
  const auto found = makers.find(id);
  return found == makers.end() ? nullptr : found->second;
}

inline TreeNode::Ptr make_stand_in(Program& program, std::uint32_t index, const NodePlace& place,
                                   NodeType type) {
  if (const StandInMaker make = class_of(place.id)) return make(program, index, place);
  switch (type) {
    case NodeType::CONDITION:
      return stand_in<Other<ConditionNode>>(program, index, place);
    case NodeType::CONTROL:
      return stand_in<Other<ControlNode>>(program, index, place);
    case NodeType::DECORATOR:
      return stand_in<Other<DecoratorNode>>(program, index, place);
    default:
      return stand_in<OtherAction>(program, index, place);
  }
}

}  // namespace BT::lockstep_detail
