// When the ticks of a run are due: multiples of the period from its start, so there is no drift.
// All times count from the start. Used by the loop, by verify, by code that needs the period of a
// rate, and by nodes that count time.
#pragma once

#include <cstdint>

#include "base/core/clock.h"

namespace lockstep::host {

// After it no tick comes: all times of a run fit 64 bits.
inline constexpr Nanoseconds kLongestRun = std::chrono::seconds(9'000'000'000);

Nanoseconds deadline_of(std::uint64_t k, double rate);

// deadline_of at one rate.
class Deadlines {
 public:
  Deadlines() = default;  // each nanosecond: of ticks that come at any time
  explicit Deadlines(double rate);

  // At a rate whose period is a whole number of nanoseconds, as 100 Hz, without the
  // division, which can take longer than the tick of a small tree.
  Nanoseconds at(std::uint64_t k) const {
    return period_ != 0 ? Nanoseconds(k * period_) : divided(k);
  }
  // The first that has not passed at `time`.
  std::uint64_t first_from(Nanoseconds time) const;

  // The time from one tick to another. At 30 Hz deadlines are rounded, so that their difference can
  // be a nanosecond too short or too long: of the same number of periods it is always the same.
  Nanoseconds between(Nanoseconds from, Nanoseconds to) const {
    return period_ != 0 ? to - from : whole_periods(to - from);
  }
  // Such a time in seconds. One period is 1/30 s at 30 Hz, and not 33,333,333 ns.
  double seconds_of(Nanoseconds between) const {
    return period_ != 0 ? to_seconds(between) : exact_seconds(between);
  }
  // The shortest such time that is not less than this one.
  Nanoseconds at_least(Nanoseconds time) const {
    return period_ != 0 ? time : at(first_from(time));
  }

 private:
  Nanoseconds divided(std::uint64_t k) const;
  Nanoseconds whole_periods(Nanoseconds time) const;
  double exact_seconds(Nanoseconds time) const;

  double rate_ = 1e9;
  std::uint64_t period_ = 1;  // 0: not whole
};

}  // namespace lockstep::host
