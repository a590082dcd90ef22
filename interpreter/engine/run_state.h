// The memory of a Ticker about one run. A copy preserves it. The entries, the parameters from
// entries and the leaves are separate (engine/saved_run.h has them all).
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/core/clock.h"
#include "base/core/status.h"
#include "base/core/value.h"
#include "engine/node_kind.h"

namespace lockstep::host {

struct Tree;

inline constexpr std::uint8_t kWithheld = 8;  // above the bits of a Status
static_assert(index_of(kLastStatus) < kWithheld);

// A node's status and whether its ticks are withheld, in one byte. Each status is an Activity.
enum class Activity : std::uint8_t {
  Idle = 0,
  Running = 1,
  Success = 2,
  Failure = 3,
  Skipped = 4,
  Paused = kWithheld | 1,  // Running, where a synchronized parallel withholds the ticks
};

constexpr Status status_of(Activity activity) {
  return static_cast<Status>(static_cast<std::uint8_t>(activity) & (kWithheld - 1u));
}

// A node after a tick, or after a moment of one, in one byte (engine/moments.h).
struct NodeState {
  static constexpr std::uint8_t kTicked = 16;  // above the bits of an Activity

  std::uint8_t bits = 0;

  static constexpr NodeState of(Activity activity, bool ticked) {
    return {
        static_cast<std::uint8_t>(static_cast<std::uint8_t>(activity) | (ticked ? kTicked : 0u))};
  }
  constexpr Activity activity() const { return static_cast<Activity>(bits & (kTicked - 1u)); }
  constexpr Status status() const { return status_of(activity()); }
  constexpr bool ticked() const { return (bits & kTicked) != 0; }
  constexpr bool held() const { return activity() == Activity::Paused; }
  constexpr NodeState without_hold() const {
    return held() ? of(Activity::Running, ticked()) : *this;
  }

  friend bool operator==(const NodeState&, const NodeState&) = default;
};

// A leaf failed as a program. The run ends: no leaf is started or ticked after it.
struct Fault {
  NodeIndex node = 0;
  std::string message;        // "threw …", "returned status 7, …"
  bool in_last_halt = false;  // it could not be halted at the end of the run

  friend bool operator==(const Fault&, const Fault&) = default;
};

// A leaf has reported a progress outside [0, 1], which was clamped.
struct OutOfRange {
  NodeIndex node = 0;
  double reported = 0;

  friend bool operator==(const OutOfRange&, const OutOfRange&) = default;
};

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
