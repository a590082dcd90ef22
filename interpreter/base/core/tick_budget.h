// The time that one tick may wait for answers from other processes: all who wait in it share it,
// so a tick that asks ten conditions waits no longer than one that asks a single one.
#pragma once

#include <algorithm>

#include "base/core/clock.h"

namespace lockstep::host {

class TickBudget {
 public:
  // What the tick at `now` may still wait, of `limit`.
  Nanoseconds left(Nanoseconds now, Nanoseconds limit) {
    if (now != now_) used_ = Nanoseconds(0);
    now_ = now;
    return std::max(limit - used_, Nanoseconds(0));
  }
  void use(Nanoseconds waited) { used_ += waited; }

 private:
  Nanoseconds now_{-1}, used_{0};
};

}  // namespace lockstep::host
