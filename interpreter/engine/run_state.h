// The memory of a Ticker about one run. A copy preserves it. The entries, the parameters from
// entries and the leaves are separate (engine/saved_run.h has them all).
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/core/clock.h"
#include "base/core/value.h"
#include "trace/faults.h"

namespace lockstep::host {

struct Tree;

struct RunState {
  RunState() = default;
  explicit RunState(const Tree& tree);

  // Resets everything, without allocating.
  void reset();

  std::vector<Activity> activity;        // of each node
  std::vector<std::uint32_t> last_tick;  // number of the last tick that reached it; 0 = none yet
  std::vector<std::uint64_t> bytes;      // the states of the nodes, 8-byte aligned

  Nanoseconds now{0};
  std::uint32_t tick_number = 0;
  std::uint32_t asked_by = 0;  // a node and 1 more; 0: nobody
  bool in_last_halt = false;
  bool interrupted = false;  // faulted, or a node is to fail: a tick is not as any other
  bool faulted = false;
  Fault fault;
  std::vector<NodeIndex> failing;        // in their next tick
  std::vector<NodeIndex> failed_leaves;  // whose slots are marked failed; some are not any more
  std::vector<Fault> tolerated;
  std::vector<NodeIndex> ended;  // that succeeded in the last tick, and were ended later in it
  std::vector<OutOfRange> out_of_range;
  std::unordered_map<NodeIndex, Value> kept_values;

  friend bool operator==(const RunState&, const RunState&) = default;
};

}  // namespace lockstep::host
