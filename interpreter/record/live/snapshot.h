// A run at one moment, for a terminal, a replay or a web page: the state of its nodes, the entries
// of its blackboard, what its leaves logged last. Plain data. What does not change is in Shape.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/core/clock.h"
#include "judge/measure/entry_changes.h"
#include "run/leaf_lines.h"
#include "trace/node_state.h"
#include "trace/observer.h"

namespace lockstep::host {

struct NodeView {
  Activity activity = Activity::Idle;
  double progress = 0;  // children of synchronized nodes only
  double factor = 1;    // how fast it is to be, where its parent paces it
  Round round = {};     // of a node that runs its child again and again; number 0: not known
  double limit = 0;     // synchronized nodes only: that counted, see base/core/synchronization.h
};

// The progress to show of a child of a synchronized node, given what the node used in its last
// tick.
inline double shown_progress(Activity activity, double used) {
  if (activity == Activity::Idle) return 0;
  return activity == Activity::Success ? 1.0 : used;
}

struct Snapshot {
  struct Header {
    double rate_hz = 0;
    bool real_time = true;
    std::uint64_t tick = 0;
    Nanoseconds time{0};
    // Ticks that ended after the next deadline; none: not known, as of a recording.
    std::optional<std::uint64_t> overruns = 0;
    std::optional<Nanoseconds> resumed_after = {};  // a cut, in this process
    std::optional<RunResult> result = {};           // once the run has ended
  } header;
  std::vector<NodeView> nodes;           // by index
  std::vector<EntryState> entries = {};  // in the order of Shape::entries
  RecentLines logs = {};
  std::vector<Heard> heard = {};  // of each node that stands for another robot
};

}  // namespace lockstep::host
