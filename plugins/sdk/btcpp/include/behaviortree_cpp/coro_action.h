// An action whose tick() gives the control back in its middle. Included by action_node.h.
#pragma once

#include <memory>
#include <string>

#include "behaviortree_cpp/leaf_node.h"
#include "behaviortree_cpp/lockstep/coroutine.h"

namespace BT {

class CoroActionNode : public ActionNodeBase {
 public:
  CoroActionNode(const std::string& name, const NodeConfig& config)
      : ActionNodeBase(name, config) {}

  // In tick(): the node runs, and goes on here in the next tick.
  void setStatusRunningAndYield() {
    setStatus(NodeStatus::RUNNING);
    coroutine_->yield();
  }

  NodeStatus executeTick() final {
    if (coroutine_ == nullptr) {
      coroutine_ = std::make_unique<detail::Coroutine>([this] { result_ = tick(); });
    }
    if (!coroutine_->resume()) return NodeStatus::RUNNING;
    const auto ended = std::move(coroutine_);
    ended->rethrow();
    if (result_ == NodeStatus::RUNNING || result_ == NodeStatus::IDLE) {
      throw LogicError("node '", name(), "': tick() of a CoroActionNode has returned ",
                       toStr(result_), "; to run on, it calls setStatusRunningAndYield()");
    }
    setStatus(result_ == NodeStatus::SKIPPED ? NodeStatus::IDLE : result_);
    return result_;
  }

  // Forgets where tick() was: what it has on its stack is not destroyed.
  void halt() override {
    coroutine_.reset();
    resetStatus();
  }

 private:
  std::unique_ptr<detail::Coroutine> coroutine_;
  NodeStatus result_ = NodeStatus::IDLE;
};

}  // namespace BT
