// Draws a tree and the state of its nodes as lines of text. A pure function: the live console calls
// it ten times a second, tests compare its text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/clock.h"
#include "engine/run_state.h"
#include "engine/tree.h"

namespace lockstep {

struct NodeView {
  Activity activity = Activity::Idle;
  double progress = 0;  // children of synchronized nodes only
};

struct Snapshot {
  struct Header {
    double rate_hz = 0;
    bool real_time = true;
    std::uint64_t tick = 0;
    Nanoseconds time{0};
    std::uint64_t overruns = 0;       // ticks that ended after the next deadline
    Status result = Status::Running;  // of the root
    bool ended = false;
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
std::string draw(const Tree& tree, const Snapshot& snapshot, const DrawOptions& options);

}  // namespace lockstep
