#include "engine/run_state.h"

#include <algorithm>

#include "engine/tree.h"

namespace lockstep::host {

RunState::RunState(const Tree& tree)
    : activity(tree.nodes.size(), Activity::Idle),
      last_tick(tree.nodes.size(), 0),
      bytes((tree.state_size + 7) / 8, 0) {
  ended.reserve(tree.nodes.size());
}

void RunState::reset() {
  std::ranges::fill(activity, Activity::Idle);
  std::ranges::fill(last_tick, 0);
  std::ranges::fill(bytes, 0);
  now = Nanoseconds(0);
  tick_number = asked_by = 0;
  in_last_halt = interrupted = faulted = false;
  fault = {};
  failing.clear();
  failed_leaves.clear();
  tolerated.clear();
  ended.clear();
  out_of_range.clear();
  kept_values.clear();
}

}  // namespace lockstep::host
