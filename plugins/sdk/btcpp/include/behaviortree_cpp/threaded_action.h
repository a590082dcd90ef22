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
    if (isStatusCompleted(status()) && !lockstep_runs_) return status();
    const NodeStatus result = lockstep_result_of([this] { return lockstep_follow(); });
    if (result != NodeStatus::RUNNING) lockstep_note(result);
    return result;
  }

  // Asks tick() to return, and waits for it. A class that overrides it calls it. What tick() has
  // returned is the status until a parent, or haltNode(), resets it.
  void halt() override {
    const bool runs = status() == NodeStatus::RUNNING;
    lockstep_is_halt_requested_ = true;
    lockstep_worker_.stop();
    lockstep_runs_ = false;
    if (runs && isStatusCompleted(lockstep_worker_.result())) {
      setStatus(lockstep_worker_.result());
    } else {
      resetStatus();
    }
  }

 private:
  NodeStatus lockstep_follow() {
    if (status() == NodeStatus::IDLE || !lockstep_runs_) lockstep_launch();
    if (!lockstep_worker_.is_done()) return NodeStatus::RUNNING;
    lockstep_runs_ = false;
    const NodeStatus result = lockstep_worker_.take();
    lockstep_end_thread();
    if (!isStatusCompleted(result)) {
      throw LogicError("node '", name(), "': tick() of a ThreadedAction has returned ",
                       toStr(result));
    }
    return result;
  }
  void lockstep_launch() {
    lockstep_is_halt_requested_ = true;  // what was reset without a halt ends here
    lockstep_worker_.stop();
    lockstep_is_halt_requested_ = false;
    lockstep_begin_thread();
    setStatus(NodeStatus::RUNNING);
    lockstep_runs_ = true;
    const auto work = [this] { return tick(); };
    lockstep_worker_.launch(*this, work, [this] { lockstep_show_end(); });
  }
  // By hand, the result is the status when tick() has returned, before the next tick takes it.
  void lockstep_show_end() {
    if (lockstep_is_in_tree()) return;
    const NodeStatus result = lockstep_worker_.result();
    if (isStatusCompleted(result)) setStatus(result);
    emitWakeUpSignal();
  }
  bool lockstep_is_told() const override { return !lockstep_runs_; }

  std::atomic<bool> lockstep_is_halt_requested_{false};
  bool lockstep_runs_ = false;  // it was begun, and its result has not been taken
  lockstep_detail::NodeThread lockstep_worker_;
};
#ifdef USE_BTCPP3_OLD_NAMES
using AsyncActionNode = ThreadedAction;
#endif

}  // namespace BT
