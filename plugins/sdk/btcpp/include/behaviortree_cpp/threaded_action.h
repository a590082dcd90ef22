// An action whose tick() blocks: it runs in a thread. Included by action_node.h.
#pragma once

#include <atomic>
#include <string>

#include "behaviortree_cpp/leaf_node.h"
#include "behaviortree_cpp/lockstep/thread.h"

namespace BT {

// In tick(), getInput gives what the ports had in the first tick of the activation, and what
// setOutput sets is written when tick() has returned.
class ThreadedAction : public ActionNodeBase {
 public:
  ThreadedAction(const std::string& name, const NodeConfig& config)
      : ActionNodeBase(name, config) {}
  ~ThreadedAction() override { worker_.stop(); }

  // Ask it in tick() again and again. On the virtual clock the thread waits here for the next tick.
  bool isHaltRequested() const {
    if (!is_halt_requested_) worker_.yield();
    return is_halt_requested_;
  }

  NodeStatus executeTick() final {
    if (status() != NodeStatus::RUNNING) {
      is_halt_requested_ = false;
      begin_thread();
      setStatus(NodeStatus::RUNNING);
      worker_.launch(*this, [this] { return tick(); });
    }
    if (!worker_.is_done()) return NodeStatus::RUNNING;
    const NodeStatus status = worker_.take();
    end_thread();
    if (!isStatusCompleted(status)) {
      throw LogicError("node '", name(), "': tick() of a ThreadedAction has returned ",
                       toStr(status));
    }
    setStatus(status);
    return status;
  }

  // Asks tick() to return, and waits for it. A class that overrides it calls it.
  void halt() override {
    is_halt_requested_ = true;
    worker_.stop();
    resetStatus();
  }

 private:
  std::atomic<bool> is_halt_requested_{false};
  detail::NodeThread worker_;
};
using AsyncActionNode = ThreadedAction;

}  // namespace BT
