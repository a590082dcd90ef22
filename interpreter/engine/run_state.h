// The state of all nodes in one run, as plain bytes: a fill resets it and a copy preserves it. The
// leaves of plugins and the blackboard are separate.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/status.h"
#include "engine/tree.h"

namespace lockstep {

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

struct RunState {
  explicit RunState(const Tree& tree)
      : activity(tree.nodes.size(), Activity::Idle),
        last_tick(tree.nodes.size(), 0),
        bytes((tree.state_size + 7) / 8, 0) {}

  // Resets everything, without allocating.
  void reset() {
    std::ranges::fill(activity, Activity::Idle);
    std::ranges::fill(last_tick, 0);
    std::ranges::fill(bytes, 0);
  }

  std::vector<Activity> activity;        // of each node
  std::vector<std::uint32_t> last_tick;  // number of the last tick that reached it; 0 = none yet
  std::vector<std::uint64_t> bytes;      // the states of the nodes, 8-byte aligned

  friend bool operator==(const RunState&, const RunState&) = default;
};

}  // namespace lockstep
