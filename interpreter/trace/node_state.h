// A node of a run, as all who tick, watch, measure, draw and record it know it: by its index in
// pre-order, the groups behind the tree; and by its state.
#pragma once

#include <cstdint>

#include "base/core/status.h"

namespace lockstep::host {

using NodeIndex = std::uint32_t;

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

// A node after a tick, or after a moment of one, in one byte (trace/moments_view.h).
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

// The current round of a node that repeats its child, from 1, and the number of rounds; 0: endless.
struct Round {
  std::int64_t number = 0, of = 0;

  friend bool operator==(const Round&, const Round&) = default;
};

}  // namespace lockstep::host
