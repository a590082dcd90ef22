// Counts what happens to each node of a tree.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>

#include "behaviortree_cpp/loggers/abstract_logger.h"

namespace BT {

class TreeObserver : public StatusChangeLogger {
 public:
  explicit TreeObserver(const Tree& tree) {
    tree.applyVisitor([this](const TreeNode* node) {
      statistics_.emplace(node->UID(), NodeStatistics());
      path_to_uid_.emplace(node->fullPath(), node->UID());
      uid_to_path_.emplace(node->UID(), node->fullPath());
    });
    subscribeToTreeChanges(tree.rootNode());
  }
  ~TreeObserver() override { unsubscribeFromTreeChanges(); }
  void flush() override {}

  struct NodeStatistics {
    NodeStatus last_result = NodeStatus::IDLE;     // the last SUCCESS or FAILURE
    NodeStatus current_status = NodeStatus::IDLE;  // any
    unsigned transitions_count = 0;                // to all but IDLE
    unsigned success_count = 0, failure_count = 0, skip_count = 0;
    Duration last_timestamp = {};
  };

  void resetStatistics() {
    for (auto& [uid, it] : statistics_) it = NodeStatistics();
  }
  // By the path of the node.
  const NodeStatistics& getStatistics(const std::string& path) const {
    const auto found = path_to_uid_.find(path);
    if (found == path_to_uid_.end()) {
      throw RuntimeError("the tree has no node with the path '", path,
                         "': TreeNode::fullPath() gives that of each");
    }
    return getStatistics(found->second);
  }
  const NodeStatistics& getStatistics(std::uint16_t uid) const {
    const auto found = statistics_.find(uid);
    if (found == statistics_.end()) {
      throw RuntimeError("the tree has no node with the UID ", std::to_string(uid));
    }
    return found->second;
  }
  const std::unordered_map<std::uint16_t, NodeStatistics>& statistics() const {
    return statistics_;
  }
  const std::unordered_map<std::string, std::uint16_t>& pathToUID() const { return path_to_uid_; }
  const std::map<std::uint16_t, std::string>& uidToPath() const { return uid_to_path_; }

 private:
  void callback(Duration timestamp, const TreeNode& node, NodeStatus /*before*/,
                NodeStatus now) override {
    NodeStatistics& it = statistics_[node.UID()];
    it.current_status = now;
    it.last_timestamp = timestamp;
    if (now != NodeStatus::IDLE) ++it.transitions_count;
    if (isStatusCompleted(now)) it.last_result = now;
    if (now == NodeStatus::SUCCESS) ++it.success_count;
    if (now == NodeStatus::FAILURE) ++it.failure_count;
    if (now == NodeStatus::SKIPPED) ++it.skip_count;
  }

  std::unordered_map<std::uint16_t, NodeStatistics> statistics_;
  std::unordered_map<std::string, std::uint16_t> path_to_uid_;
  std::map<std::uint16_t, std::string> uid_to_path_;
};

}  // namespace BT
