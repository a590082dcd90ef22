// For tests with the library. lockstep has no substitution rules: addSubstitutionRule says what to
// use instead.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "behaviortree_cpp/lockstep/absent_node.h"

namespace BT {

struct TestNodeConfig {
  NodeStatus return_status = NodeStatus::SUCCESS;
  std::string return_status_script;
  std::string success_script;
  std::string failure_script;
  std::string post_script;
  std::chrono::milliseconds async_delay{0};
  std::function<NodeStatus()> complete_func;
};

class TestNode : public lockstep_detail::LockstepAbsentNode<ActionNodeBase> {
 public:
  using LockstepAbsentNode::LockstepAbsentNode;
};

}  // namespace BT
