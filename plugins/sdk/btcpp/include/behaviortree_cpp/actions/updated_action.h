// As the tag WasEntryUpdated.
#pragma once

#include <string>

#include "behaviortree_cpp/action_node.h"
#include "behaviortree_cpp/lockstep/seen_entry.h"

namespace BT {

class EntryUpdatedAction : public SyncActionNode {
 public:
  using LockstepOpens = void;  // uses entries by their names
  EntryUpdatedAction(const std::string& name, const NodeConfig& config)
      : SyncActionNode(name, config), lockstep_entry_(config) {
    setRegistrationID("WasEntryUpdated");
  }
  static PortsList providedPorts() { return {InputPort<Any>("entry", "the entry to look at")}; }

 protected:
  NodeStatus tick() override {
    return lockstep_entry_.is_written(config()) ? NodeStatus::SUCCESS : NodeStatus::FAILURE;
  }

 private:
  lockstep_detail::SeenEntry lockstep_entry_;
};

}  // namespace BT
