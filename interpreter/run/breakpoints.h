// Where a run is to pause: after a tick in which something happens to a node. Used by run_control.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/ticker.h"

namespace lockstep::host {

struct Breakpoint {
  enum class When : std::uint8_t {
    Begins,     // the node; not if it completes at once as it did in the tick before
    Completes,  // it; likewise
    Barrier,    // a child comes to the limit of this synchronized node, or the limit moves on
    Succeeds,   // the node; not if it did so in the tick before
    Fails,      // likewise
  };
  NodeIndex node = 0;
  When when = When::Begins;

  friend bool operator==(const Breakpoint&, const Breakpoint&) = default;
};

class Breakpoints {
 public:
  // The node is one of the tree; Barrier needs a synchronized one.
  void set(Ticker& ticker, Breakpoint breakpoint);
  void remove(Breakpoint breakpoint);

  // After each tick: the first that was reached in it.
  std::optional<Breakpoint> reached(Ticker& ticker);

 private:
  struct Watched {
    Breakpoint breakpoint;
    NodeState before = {};             // after the last tick
    std::vector<bool> were_held = {};  // the children of a synchronized node
    double limit = 0;
  };
  bool is_reached(Ticker& ticker, Watched& watched);
  static bool is_reached(NodeState state, Watched& watched);
  static bool is_barrier_reached(Ticker& ticker, Watched& watched);

  std::vector<Watched> watched_;
  std::vector<NodeState> moment_;
};

}  // namespace lockstep::host
