// As the tags Sequence and AsyncSequence.
#pragma once

#include <string>

#include "behaviortree_cpp/lockstep/row_node.h"

namespace BT {

class SequenceNode : public lockstep_detail::LockstepRowNode {
 public:
  explicit SequenceNode(const std::string& name, bool make_async = false,
                        const NodeConfig& config = {})
      : LockstepRowNode(name, NodeStatus::SUCCESS, make_async, config) {
    setRegistrationID(make_async ? "AsyncSequence" : "Sequence");
  }
};

}  // namespace BT
