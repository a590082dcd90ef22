// As the tag Sequence, for classes that derive from it.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class SequenceNode : public lockstep_detail::LockstepRowNode {
 public:
  explicit SequenceNode(const std::string& name, bool make_async = false,
                        const NodeConfig& config = {})
      : LockstepRowNode(name, NodeStatus::SUCCESS, make_async, config) {}
};

}  // namespace BT
