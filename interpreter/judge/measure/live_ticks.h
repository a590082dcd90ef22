// The tick views of a run that a Ticker makes. Does not allocate after construction.
#pragma once

#include <optional>
#include <vector>

#include "judge/measure/measuring.h"
#include "judge/measure/synchronized_measure.h"

namespace lockstep::host {

class LiveTicks {
 public:
  // Views what `measuring` measures in this tree.
  LiveTicks(const Tree& tree, const Measuring& measuring);
  LiveTicks(const LiveTicks&) = delete;
  LiveTicks& operator=(const LiveTicks&) = delete;

  void before_tick(Ticker& ticker);
  // After the tick. Valid until the next call.
  const TickView& read(Ticker& ticker, std::uint64_t tick, Nanoseconds time);

 private:
  void read_others(Ticker& ticker);

  struct Node {
    NodeIndex index;
    std::optional<NodeIndex> parent;  // the synchronized node that holds it, if any
    std::size_t child;                // the node's place among its children
  };
  std::vector<SynchronizedProbe> parallels_;
  std::vector<Node> nodes_;
  std::vector<NodeIndex> users_;
  std::vector<std::size_t> slots_;
  std::vector<double> numbers_;  // in them
  std::vector<SynchronizedTick> parallel_ticks_;
  std::vector<NodeTick> node_ticks_;
  std::vector<ResourceTick> user_ticks_;
  const bool has_others_;  // more than parallels
  bool asks_;              // nodes for their progress, before a tick
  TickView view_;          // of all these
};

}  // namespace lockstep::host
