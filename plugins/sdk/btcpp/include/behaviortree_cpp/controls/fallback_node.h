// As the tags Fallback and AsyncFallback.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class FallbackNode : public lockstep_detail::LockstepRowNode {
 public:
  explicit FallbackNode(const std::string& name, bool make_async = false,
                        const NodeConfig& config = {})
      : LockstepRowNode(name, NodeStatus::FAILURE, make_async, config) {
    setRegistrationID(make_async ? "AsyncFallback" : "Fallback");
  }
};

}  // namespace BT
