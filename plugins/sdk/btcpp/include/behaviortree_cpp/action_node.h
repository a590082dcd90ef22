// Nodes that do something.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "behaviortree_cpp/leaf_node.h"

namespace BT {

class ActionNodeBase : public LeafNode {
 public:
  ActionNodeBase(const std::string& name, const NodeConfig& config);
  ~ActionNodeBase() override;
  NodeType type() const final { return NodeType::ACTION; }
};

// Done in one tick.
class SyncActionNode : public ActionNodeBase {
 public:
  SyncActionNode(const std::string& name, const NodeConfig& config);
  ~SyncActionNode() override;

  // Here, so that the compiler sees it beside tick().
  NodeStatus executeTick() override {
    const NodeStatus status = lockstep_tick_as([this] { return tick(); });
    if (status == NodeStatus::RUNNING) {
      lockstep_refuse(
          "is a SyncActionNode and has returned RUNNING; derive it from StatefulActionNode");
    }
    return status;
  }
  void halt() final { resetStatus(); }
};

class SimpleActionNode : public SyncActionNode {
 public:
  using TickFunctor = std::function<NodeStatus(TreeNode&)>;
  SimpleActionNode(const std::string& name, TickFunctor function, const NodeConfig& config);
  ~SimpleActionNode() override;

 protected:
  NodeStatus tick() final;

 private:
  TickFunctor lockstep_function_;
};

// Takes several ticks.
class StatefulActionNode : public ActionNodeBase {
 public:
  StatefulActionNode(const std::string& name, const NodeConfig& config);
  ~StatefulActionNode() override;

  // The first tick of an activation.
  virtual NodeStatus onStart() = 0;
  // Each tick after that, while it runs.
  virtual NodeStatus onRunning() = 0;
  // It runs and must stop now.
  virtual void onHalted() = 0;

  // True after the first halt, for ever.
  bool isHaltRequested() const { return lockstep_is_halt_requested_; }

 protected:
  NodeStatus tick() final;
  void halt() final;

 private:
  std::atomic<bool> lockstep_is_halt_requested_{false};
};

}  // namespace BT

#include "behaviortree_cpp/coro_action.h"      // IWYU pragma: export
#include "behaviortree_cpp/threaded_action.h"  // IWYU pragma: export

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/action_node.h"  // IWYU pragma: export
#endif
