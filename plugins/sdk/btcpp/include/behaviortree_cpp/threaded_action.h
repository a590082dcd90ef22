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
  ~ThreadedAction() override { lockstep_worker_.stop(); }

  // Ask it in tick() again and again. On the virtual clock the thread waits here for the next tick.
  bool isHaltRequested() const {
    if (!lockstep_is_halt_requested_) lockstep_worker_.yield();
    return lockstep_is_halt_requested_;
  }

  NodeStatus executeTick() final {
    if (isStatusCompleted(status())) return status();
    if (status() != NodeStatus::RUNNING) {
      lockstep_is_halt_requested_ = false;
      lockstep_begin_thread();
      setStatus(NodeStatus::RUNNING);
      lockstep_worker_.launch(*this, [this] { return tick(); });
    }
    if (!lockstep_worker_.is_done()) return NodeStatus::RUNNING;
    const NodeStatus status = lockstep_worker_.take();
    lockstep_end_thread();
    if (!isStatusCompleted(status)) {
      throw LogicError("node '", name(), "': tick() of a ThreadedAction has returned ",
                       toStr(status));
    }
    setStatus(status);
    return status;
  }

  // Asks tick() to return, and waits for it. A class that overrides it calls it.
  void halt() override {
    lockstep_is_halt_requested_ = true;
    lockstep_worker_.stop();
    resetStatus();
  }

 private:
  std::atomic<bool> lockstep_is_halt_requested_{false};
  lockstep_detail::NodeThread lockstep_worker_;
};
#ifdef USE_BTCPP3_OLD_NAMES
using AsyncActionNode = ThreadedAction;
#endif

}  // namespace BT
