// Calls a function for each change of a node's status, when it happens.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <utility>
#include <vector>

#include "behaviortree_cpp/behavior_tree.h"
#include "behaviortree_cpp/bt_factory.h"

namespace BT {

enum class TimestampType { absolute, relative };

class StatusChangeLogger {
 public:
  explicit StatusChangeLogger(TreeNode* root_node) { subscribeToTreeChanges(root_node); }
  virtual ~StatusChangeLogger() { unsubscribeFromTreeChanges(); }
  StatusChangeLogger(const StatusChangeLogger&) = delete;
  StatusChangeLogger& operator=(const StatusChangeLogger&) = delete;

  virtual void callback(Duration timestamp, const TreeNode& node, NodeStatus before,
                        NodeStatus now) = 0;
  virtual void flush() = 0;

  void setEnabled(bool enabled) { lockstep_enabled_ = enabled; }
  bool enabled() const { return lockstep_enabled_; }
  void setTimestampType(TimestampType type) { lockstep_type_ = type; }
  bool showsTransitionToIdle() const { return lockstep_shows_idle_; }
  void enableTransitionToIdle(bool enable) { lockstep_shows_idle_ = enable; }

 protected:
  // For a class that subscribes when it is complete.
  StatusChangeLogger() = default;
  void subscribeToTreeChanges(TreeNode* root_node) {
    if (root_node == nullptr) throw LogicError("a logger wants the rootNode() of a BT::Tree");
    const std::lock_guard lock(lockstep_mutex_);
    lockstep_subscribers_.clear();
    lockstep_began_ = std::chrono::high_resolution_clock::now();
    applyRecursiveVisitor(root_node, [this](TreeNode* node) {
      lockstep_subscribers_.push_back(node->subscribeToStatusChange(
          [this](TimePoint time, const TreeNode& it, NodeStatus before, NodeStatus now) {
            lockstep_note(time, it, before, now);
          }));
    });
  }
  // No callback any more; one that is in progress has returned then.
  void unsubscribeFromTreeChanges() {
    const std::lock_guard lock(lockstep_mutex_);
    lockstep_subscribers_.clear();
  }

 private:
  void lockstep_note(TimePoint time, const TreeNode& node, NodeStatus before, NodeStatus now) {
    const std::lock_guard lock(lockstep_mutex_);
    if (lockstep_subscribers_.empty() || !lockstep_enabled_) return;
    if (now == NodeStatus::IDLE && !lockstep_shows_idle_) return;
    const bool is_relative = lockstep_type_ == TimestampType::relative;
    callback(is_relative ? time - lockstep_began_ : time.time_since_epoch(), node, before, now);
  }

  std::recursive_mutex lockstep_mutex_;  // a callback may be in a thread of a node
  std::vector<TreeNode::StatusChangeSubscriber> lockstep_subscribers_;
  std::atomic<bool> lockstep_enabled_{true}, lockstep_shows_idle_{true};
  std::atomic<TimestampType> lockstep_type_{TimestampType::absolute};
  TimePoint lockstep_began_;
};

}  // namespace BT
