// Ends standstills: before a tick it tells the ticker which nodes are to fail in it. Used by the
// loop, since an observer only reads.
#pragma once

#include <functional>
#include <vector>

#include "judge/measure/stall.h"
#include "run/live_moments.h"

namespace lockstep::host {

class StallFail {
 public:
  // After the tick in which a node has failed.
  using Report = std::function<void(const Standstill& standstill, NodeIndex failed)>;
  StallFail(const Tree& tree, Nanoseconds limit, Report report);

  // Around each tick of the tree; the time is that of the tick.
  void before_tick(Ticker& ticker, Nanoseconds now);
  void after_tick(Ticker& ticker, Nanoseconds time);

 private:
  using Standing = StandingNodes::Standing;
  struct Order {
    Standstill standstill;
    NodeIndex node;
  };
  void look(Ticker& ticker, Standing& at, Nanoseconds now);
  void order(Ticker& ticker, Standstill found);
  static bool is_due(const Standstill& found, NodeIndex node);
  bool comes_on(Ticker& ticker, Standing& at);
  bool comes_on(Ticker& ticker, const Standstill& circle);

  const Tree& tree_;
  const Shape shape_;
  LiveMoments moments_;
  StandingNodes nodes_;
  std::vector<Order> orders_;  // of this tick
  Report report_;
};

// The node that stands still: of a chain, the synchronized node at its end; instead of a barrier
// the lowest node that all of its members are below; of a circle, the lowest that contains it.
NodeIndex stalled_node(const Tree& tree, const Standstill& standstill);

}  // namespace lockstep::host
