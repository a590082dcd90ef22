// A clock that is 1 ns later each time it is read: what reading a real one takes differs from
// machine to machine.
#pragma once

#include "base/core/clock.h"

namespace lockstep::host::test {

class StepClock final : public Clock {
 public:
  Nanoseconds now() override { return time_ += Nanoseconds(1); }
  void sleep_until(Nanoseconds) override {}
  bool is_real() const override { return true; }

 private:
  Nanoseconds time_{0};
};

}  // namespace lockstep::host::test
