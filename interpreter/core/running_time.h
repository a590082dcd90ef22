// How long something has lasted, counted only while this process itself ran: who waits looks at the
// clock in short intervals, and a look that comes late counts as two of them. Between the two the
// process was stopped (SIGSTOP, docker pause, a debugger), which is nobody's fault.
#pragma once

#include <algorithm>

#include "core/clock.h"

namespace lockstep {

class RunningTime {
 public:
  // Short enough for `limit` to be noticed soon after it is reached.
  static constexpr Nanoseconds interval_for(Nanoseconds limit) {
    using namespace std::chrono_literals;
    return std::clamp<Nanoseconds>(limit / 8, 10ms, 100ms);
  }

  RunningTime(Nanoseconds interval, Nanoseconds now) : interval_(interval), last_(now) {}

  Nanoseconds interval() const { return interval_; }
  // Since the last look or, the first time, since the beginning.
  Nanoseconds look(Nanoseconds now) {
    const Nanoseconds passed = std::min(now - last_, 2 * interval_);
    last_ = now;
    return passed;
  }

 private:
  Nanoseconds interval_;
  Nanoseconds last_;
};

}  // namespace lockstep
