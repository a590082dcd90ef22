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

  void setEnabled(bool enabled) { enabled_ = enabled; }
  bool enabled() const { return enabled_; }
  void setTimestampType(TimestampType type) { type_ = type; }
  bool showsTransitionToIdle() const { return shows_idle_; }
  void enableTransitionToIdle(bool enable) { shows_idle_ = enable; }

 protected:
  StatusChangeLogger() = default;
  void subscribeToTreeChanges(TreeNode* root_node) {
    const auto* const root = dynamic_cast<const detail::ProgramNode*>(root_node);
    if (root == nullptr) throw LogicError("a logger wants the rootNode() of a BT::Tree");
    statuses_.assign(root->places().nodes.size(), NodeStatus::IDLE);
    observer_ = root->program().observe([this, root] { look(root->program()); });
  }
  void unsubscribeFromTreeChanges() { observer_ = nullptr; }

 private:
  void look(const detail::Program& program) {
    using Clock = std::chrono::high_resolution_clock;
    const Duration now =
        type_ == TimestampType::relative ? Clock::now() - began_ : Clock::now().time_since_epoch();
    for (std::uint32_t i = 0; i < statuses_.size(); ++i) {
      const NodeStatus status = program.status_of(i);
      const NodeStatus before = std::exchange(statuses_[i], status);
      if (before == status || !enabled_ || (status == NodeStatus::IDLE && !shows_idle_)) continue;
      callback(now, *program.nodes()[i], before, status);
    }
  }

  std::vector<NodeStatus> statuses_;
  bool enabled_ = true, shows_idle_ = true;
  TimestampType type_ = TimestampType::absolute;
  std::chrono::high_resolution_clock::time_point began_ = std::chrono::high_resolution_clock::now();
  std::shared_ptr<std::function<void()>> observer_;
};

}  // namespace BT
