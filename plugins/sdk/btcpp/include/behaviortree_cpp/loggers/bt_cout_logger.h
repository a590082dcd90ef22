// Prints each change of a node's status.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "behaviortree_cpp/bt_factory.h"

namespace BT {

class StdCoutLogger {
 public:
  explicit StdCoutLogger(const Tree& tree) {
    detail::Program* const program = &tree.program();
    std::vector<NodeStatus> before(lockstep_project_node_count(program->project()),
                                   NodeStatus::IDLE);
    program->observe([program, before]() mutable {
      for (std::uint32_t i = 0; i < before.size(); ++i) print(*program, i, before[i]);
    });
  }

 private:
  static void print(detail::Program& program, std::uint32_t index, NodeStatus& before) {
    lockstep_node_state state{};
    state.struct_size = sizeof state;
    lockstep_node node{};
    node.struct_size = sizeof node;
    if (!lockstep_run_node(program.run(), index, &state)) return;
    const auto now = static_cast<NodeStatus>(state.status);
    if (now == before || !lockstep_project_node(program.project(), index, &node)) return;
    std::printf("%s: %s -> %s\n", node.path, toStr(before).c_str(), toStr(now).c_str());
    before = now;
  }
};

}  // namespace BT
