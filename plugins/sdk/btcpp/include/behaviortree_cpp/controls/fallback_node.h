// As the tag Fallback, for classes that derive from it.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class FallbackNode : public lockstep_detail::LockstepRowNode {
 public:
  explicit FallbackNode(const std::string& name, bool make_async = false,
                        const NodeConfig& config = {})
      : LockstepRowNode(name, NodeStatus::FAILURE, make_async, config) {}
};

}  // namespace BT
