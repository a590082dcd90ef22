// Real time between the ticks of a virtual clock that is to run at a certain speed. Used by loop.
#pragma once

#include <algorithm>

#include "base/core/clock.h"

namespace lockstep::host {

class Pace {
 public:
  // 2: twice as fast as the real time; 0: as fast as possible.
  void set(Nanoseconds period, double speed) {
    if (speed == speed_) return;
    speed_ = speed;
    step_ = speed > 0 ? from_seconds(to_seconds(period) / speed) : Nanoseconds(0);
    restart();
  }
  // The next tick is due now.
  void restart() { due_ = monotonic_now(); }

  bool is_early() const { return speed_ > 0 && monotonic_now() < due_; }
  Nanoseconds left() const { return due_ - monotonic_now(); }

  // The tick comes. Those that it makes late are made up for, but not many at once.
  void count() {
    if (speed_ > 0) due_ = std::max(due_, monotonic_now() - kMostBehind) + step_;
  }

 private:
  static constexpr Nanoseconds kMostBehind = std::chrono::milliseconds(100);

  double speed_ = 0;
  Nanoseconds step_{0}, due_{0};
};

}  // namespace lockstep::host
