// The node of a tag SubTree, by hand: its child is the root of a tree. In a tree, a SubTree is made
// by its tag only.
#pragma once

#include <string>

#include "behaviortree_cpp/decorator_node.h"

namespace BT {

class SubTreeNode : public DecoratorNode {
 public:
  SubTreeNode(const std::string& name, const NodeConfig& config) : DecoratorNode(name, config) {
    setRegistrationID("SubTree");
  }
  static PortsList providedPorts() {
    PortInfo autoremap(PortDirection::INPUT, TypeInfo::Create<bool>());
    autoremap.setDescription("entries that are not remapped have the same name outside");
    autoremap.setDefaultValue(false);
    return {{"_autoremap", autoremap}};
  }

  void setSubtreeID(const std::string& id) { lockstep_id_ = id; }
  const std::string& subtreeID() const { return lockstep_id_; }
  NodeType type() const final { return NodeType::SUBTREE; }

 protected:
  NodeStatus tick() override {
    if (status() == NodeStatus::IDLE) setStatus(NodeStatus::RUNNING);
    const NodeStatus result = lockstep_tick_child();
    if (isStatusCompleted(result)) resetChild();
    return result;
  }

 private:
  std::string lockstep_id_;
};

}  // namespace BT
