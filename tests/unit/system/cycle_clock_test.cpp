#include "system/cycle_clock.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace lockstep::host::test {

// The thread may lose the processor between two readings, so one try of many must agree.
TEST_CASE("the clock for short durations agrees with the system's to a hundredth") {
  CycleClock clock;
  double nearest = 1;
  for (int tries = 0; tries < 100 && nearest > 0.01; ++tries) {
    const Nanoseconds system = monotonic_now(), cycles = clock.now();
    while (monotonic_now() - system < std::chrono::milliseconds(5)) {
    }
    const double passed = to_seconds(clock.now() - cycles);
    nearest = std::min(nearest, std::abs(passed / to_seconds(monotonic_now() - system) - 1));
    clock.adjust();
  }
  CHECK(nearest <= 0.01);
}

TEST_CASE("the clock for short durations never goes back") {
  const CycleClock clock;
  Nanoseconds last = clock.now();
  for (int reading = 0; reading < 100000; ++reading) {
    const Nanoseconds now = clock.now();
    REQUIRE(now >= last);
    last = now;
  }
}

}  // namespace lockstep::host::test
