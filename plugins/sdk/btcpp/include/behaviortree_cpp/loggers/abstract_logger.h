// Calls a function for each change of a node's status that is seen after a tick.
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

enum class TimestampType { absolute, relative };

class StatusChangeLogger {
 public:
  explicit StatusChangeLogger(TreeNode* root_node) { subscribeToTreeChanges(root_node); }
  virtual ~StatusChangeLogger() = default;
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
  StatusChangeLogger() = default;
  void subscribeToTreeChanges(TreeNode* root_node) {
    const auto* const root = dynamic_cast<const lockstep_detail::ProgramNode*>(root_node);
    if (root == nullptr) throw LogicError("a logger wants the rootNode() of a BT::Tree");
    lockstep_statuses_.assign(root->places().nodes.size(), NodeStatus::IDLE);
    lockstep_observer_ = root->program().observe([this, root] { lockstep_look(root->program()); });
  }
  void unsubscribeFromTreeChanges() { lockstep_observer_ = nullptr; }

 private:
  void lockstep_look(const lockstep_detail::Program& program) {
    using Clock = std::chrono::high_resolution_clock;
    const Duration now = lockstep_type_ == TimestampType::relative
                             ? Clock::now() - lockstep_began_
                             : Clock::now().time_since_epoch();
    for (std::uint32_t i = 0; i < lockstep_statuses_.size(); ++i) {
      const NodeStatus status = program.status_of(i);
      const NodeStatus before = std::exchange(lockstep_statuses_[i], status);
      if (before == status || !lockstep_enabled_ ||
          (status == NodeStatus::IDLE && !lockstep_shows_idle_))
        continue;
      callback(now, *program.nodes()[i], before, status);
    }
  }

  std::vector<NodeStatus> lockstep_statuses_;
  bool lockstep_enabled_ = true, lockstep_shows_idle_ = true;
  TimestampType lockstep_type_ = TimestampType::absolute;
  std::chrono::high_resolution_clock::time_point lockstep_began_ =
      std::chrono::high_resolution_clock::now();
  std::shared_ptr<std::function<void()>> lockstep_observer_;
};

}  // namespace BT
