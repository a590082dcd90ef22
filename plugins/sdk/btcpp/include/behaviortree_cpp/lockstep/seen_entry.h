// Whether an entry was written since a node looked last: what EntryUpdatedAction and
// EntryUpdatedDecorator share.
#pragma once

#include <cstdint>
#include <string>

#include "behaviortree_cpp/tree_node.h"

namespace BT::lockstep_detail {

class SeenEntry {
 public:
  // The port `entry` names it: "{key}" or "key".
  explicit SeenEntry(const NodeConfig& config) {
    const auto given = config.input_ports.find("entry");
    if (given == config.input_ports.end() || given->second.empty()) {
      throw RuntimeError("missing port [entry]: it names the entry to look at");
    }
    StringView key;
    if (given->second == "{=}" || given->second == "=") {
      key_ = "entry";
    } else {
      key_ = TreeNode::isBlackboardPointer(given->second, &key) ? std::string(key) : given->second;
    }
  }

  bool is_written(const NodeConfig& config) {
    if (config.blackboard == nullptr) throw RuntimeError("the node has no blackboard");
    const auto entry = config.blackboard->lockstep_find(key_).entry;
    if (entry == nullptr || entry->sequence_id == seen_) return false;
    seen_ = entry->sequence_id;
    return true;
  }

 private:
  std::string key_;
  std::uint64_t seen_ = 0;
};

}  // namespace BT::lockstep_detail
