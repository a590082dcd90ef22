// A measure's view of a run: each tick, after it, and the end. A live run (live_ticks.h) and a
// recording (record/use/recording_measures.cpp) both provide it, so measures work the same for
// both.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/core/clock.h"
#include "base/core/status.h"

namespace lockstep::host {

// The state of one parallel after a tick of the run.
struct SynchronizedTick {
  Nanoseconds time{0};  // when the tick of the run began, since the run began
  bool ticked = false;  // did the node ask its children in this tick? If not, only the time counts.
  Status status = Status::Idle;
  double limit = 0;  // that counted: engine/synchronized.h
  // The progress of each child as the node used it in this tick; not a number: it was left out.
  std::span<const double> used = {};
  // The same, as measures compare it: a guard, which contains no action, is left out too.
  std::span<const double> progress = {};
  // True for a child that was running and did not get this tick. It may have been halted since.
  // Empty if no measure asks for it, and so is the next.
  std::span<const bool> held = {};
  // True for a child that has succeeded, also where an ancestor has ended it since.
  std::span<const bool> succeeded = {};
};

// The state of any node after a tick of the run.
struct NodeTick {
  bool ticked = false;  // did the tick reach it?
  Status status = Status::Idle;
  double progress = 0;  // before the tick, as its parent used it
};

// The state of a node that uses resources, after a tick of the run.
struct ResourceTick {
  bool ticked = false;  // did the tick reach it?
  double limit = 0;     // what it owns or waits for: engine/resources.h
};

struct TickView {
  std::uint64_t tick = 0;  // the first is 0
  Nanoseconds time{0};     // when it began, since the run began
  // Only what is measured, in the order of MeasureTarget::place.
  std::span<const SynchronizedTick> parallels = {};
  std::span<const NodeTick> nodes = {};
  std::span<const ResourceTick> users = {};
  std::span<const double> entries = {};  // after the tick; NaN: it has no number
};

struct EndView {
  std::uint64_t ticks = 0;
  Nanoseconds last{0};                 // when the last tick began
  double rate = 0;                     // ticks per second; 0: unknown
  bool real_time = true;               // false: the clock was virtual, and every tick took 1 / rate
  std::optional<bool> succeeded = {};  // did the root? None: unknown
  std::optional<Nanoseconds> ended = {};  // when the run did; None: unknown
};

}  // namespace lockstep::host
