// What measures see of a run: each tick, after it, and the end.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/core/clock.h"
#include "base/core/status.h"
#include "trace/moment.h"

namespace lockstep::host {

// The state of one parallel after a tick of the run: judge/measure/synchronized_ticks.h.
struct SynchronizedTick {
  Nanoseconds time{0};  // when the tick of the run began, since the run began
  bool ticked = false;  // did the node ask its children in this tick? If not, only the time counts.
  Status status = Status::Idle;
  // It runs, and neither was asked nor is held: of the recording of a team, a tick of another
  // robot.
  bool is_of_others = false;
  double limit = 0;  // that counted: base/core/synchronization.h
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

struct TickView {
  const Moment* moment = nullptr;                    // of the whole run
  std::span<const SynchronizedTick> parallels = {};  // that are measured: MeasureTarget::place
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
