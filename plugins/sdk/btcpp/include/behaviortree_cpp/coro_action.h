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
    lockstep_coroutine_->yield();
  }

  NodeStatus executeTick() final {
    return lockstep_tick_as([this] { return lockstep_go_on(); });
  }

  // Forgets where tick() was: what it has on its stack is not destroyed.
  void halt() override {
    lockstep_coroutine_.reset();
    resetStatus();
  }

 private:
  NodeStatus lockstep_go_on() {
    if (status() != NodeStatus::RUNNING) lockstep_coroutine_.reset();
    if (lockstep_coroutine_ == nullptr) {
      lockstep_coroutine_ =
          std::make_unique<lockstep_detail::Coroutine>([this] { lockstep_result_ = tick(); });
    }
    if (!lockstep_coroutine_->resume()) return NodeStatus::RUNNING;
    const auto ended = std::move(lockstep_coroutine_);
    ended->rethrow();
    if (lockstep_result_ == NodeStatus::RUNNING || lockstep_result_ == NodeStatus::IDLE) {
      throw LogicError("node '", name(), "': tick() of a CoroActionNode has returned ",
                       toStr(lockstep_result_), "; to run on, it calls setStatusRunningAndYield()");
    }
    return lockstep_result_;
  }

  std::unique_ptr<lockstep_detail::Coroutine> lockstep_coroutine_;
  NodeStatus lockstep_result_ = NodeStatus::IDLE;
};

}  // namespace BT
