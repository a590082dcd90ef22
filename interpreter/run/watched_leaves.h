// Compares what the leaves of a run do with their leaf model, tick by tick. A leaf that does what
// it does not allow has a fault. Used by the loop, since an observer only reads.
#pragma once

#include "run/leaf_audit.h"
#include "run/live_moments.h"

namespace lockstep::host {

class WatchedLeaves {
 public:
  // All must outlive this. `sources`: see LeafAudit.
  WatchedLeaves(const Tree& tree, const LeafModels& models, const Sources* sources);

  // Before the first tick of this process.
  void begin(Ticker& ticker);
  // Around each tick of the tree, with its number in the run and its time.
  void before_tick(Ticker& ticker);
  void after_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time);

 private:
  const Shape shape_;
  LeafAudit audit_;
  LiveMoments moments_;
};

}  // namespace lockstep::host
