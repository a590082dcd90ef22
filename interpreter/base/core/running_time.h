// Measures how long something lasts, counting only time in which this process ran. The waiting
// thread checks the clock in short intervals. A late check counts as two intervals: between them
// the process was stopped (SIGSTOP, docker pause, a debugger).
#pragma once

#include <algorithm>
#include <optional>

#include "base/core/clock.h"

namespace lockstep::host {

class RunningTime {
 public:
  // Short enough for `limit` to be noticed soon after it is reached.
  static constexpr Nanoseconds interval_for(Nanoseconds limit) {
    using namespace std::chrono_literals;
    return std::clamp<Nanoseconds>(limit / 8, 10ms, 100ms);
  }

  RunningTime(Nanoseconds interval, Nanoseconds now) : interval_(interval), last_(now) {}

  Nanoseconds interval() const { return interval_; }
  // Since the last check or, for the first one, since the beginning.
  Nanoseconds look(Nanoseconds now) {
    const Nanoseconds passed = std::min(now - last_, 2 * interval_);
    last_ = now;
    return passed;
  }

 private:
  Nanoseconds interval_;
  Nanoseconds last_;
};

// The clock of the machine without the time in which this process was stopped, for the limits of
// what other processes do. Who measures with it looks at it at least each interval.
class RunningClock {
 public:
  static constexpr Nanoseconds kInterval = std::chrono::milliseconds(20);

  Nanoseconds now() { return now_ += time_.look(monotonic_now()); }
  // How long to wait before the next look, 0 from `until` on. Nothing: there is no limit.
  std::optional<Nanoseconds> wait_until(std::optional<Nanoseconds> until) {
    if (!until) return std::nullopt;
    return std::clamp(*until - now(), Nanoseconds(0), kInterval);
  }

 private:
  Nanoseconds now_ = monotonic_now();
  RunningTime time_{kInterval, now_};
};

}  // namespace lockstep::host
