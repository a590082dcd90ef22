#include "base/system/cycle_clock.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace lockstep::host::test {

// The thread may lose the processor between two readings, so one try of many must agree.
TEST_CASE("the clock for short durations agrees with the system's to a hundredth") {
  CycleClock clock;
  double nearest = 1;
  for (int tries = 0; tries < 100 && nearest > 0.01; ++tries) {
    const Nanoseconds system = monotonic_now();
    const std::int64_t begin = clock.count();
    while (monotonic_now() - system < std::chrono::milliseconds(5)) {
    }
    const double passed = to_seconds(clock.time_of(clock.count() - begin));
    nearest = std::min(nearest, std::abs(passed / to_seconds(monotonic_now() - system) - 1));
    clock.adjust();
  }
  CHECK(nearest <= 0.01);
}

TEST_CASE("the clock for short durations never goes back") {
  const CycleClock clock;
  std::int64_t last = clock.count();
  for (int reading = 0; reading < 100000; ++reading) {
    const std::int64_t now = clock.count();
    REQUIRE(now >= last);
    last = now;
  }
}

TEST_CASE("a time is as many counts as make that time") {
  const CycleClock clock;
  for (const std::int64_t time : {0, 1000, 1'000'000, 2'000'000'000}) {
    const Nanoseconds back = clock.time_of(clock.count_of(Nanoseconds(time)));
    CHECK(std::abs(back.count() - time) <= 2);
  }
}

}  // namespace lockstep::host::test
