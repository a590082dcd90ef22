// When the ticks of a run are due: multiples of the period from its start, so there is no drift.
// All times count from the start. Used by the loop and by code that needs the period of a rate.
#pragma once

#include <cstdint>

#include "base/core/clock.h"

namespace lockstep::host {

Nanoseconds deadline_of(std::uint64_t k, double rate);

// deadline_of at one rate.
class Deadlines {
 public:
  explicit Deadlines(double rate);

  // At a rate whose period is a whole number of nanoseconds, as 100 Hz, without the
  // division, which can take longer than the tick of a small tree.
  Nanoseconds at(std::uint64_t k) const {
    return period_ != 0 ? Nanoseconds(k * period_) : divided(k);
  }
  // The first that has not passed at `time`.
  std::uint64_t first_from(Nanoseconds time) const;

 private:
  Nanoseconds divided(std::uint64_t k) const;

  double rate_;
  std::uint64_t period_ = 0;  // 0: not whole
};

}  // namespace lockstep::host
