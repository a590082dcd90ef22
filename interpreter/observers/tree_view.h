// Draws a tree and the state of its nodes as lines of text. A pure function: the live console calls
// it ten times a second, a replay for each frame, tests compare its text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "engine/run_state.h"
#include "observers/tree_shape.h"
#include "runtime/observer.h"

namespace lockstep {

struct NodeView {
  Activity activity = Activity::Idle;
  double progress = 0;  // children of synchronized nodes only
};

// Of a child of a synchronized node, given its progress as the node used it in its last tick.
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
    std::optional<RunResult> result = {};  // once the run has ended
  } header;
  std::vector<NodeView> nodes;  // by index
};

struct DrawOptions {
  unsigned width = 80, height = 24;
  bool color = false;
  bool unicode = false;
};

// At most height - 1 lines of at most `width` columns, each ending in a newline. When the tree has
// more nodes than that, synchronized nodes, their children and running nodes come first.
std::string draw(const TreeShape& tree, const Snapshot& snapshot, const DrawOptions& options);

}  // namespace lockstep
