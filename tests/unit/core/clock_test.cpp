#include "base/core/clock.h"

#include <catch2/catch.hpp>

using namespace lockstep::host;

TEST_CASE("virtual time passes only by sleeping, and goes straight to the deadline") {
  VirtualClock clock;
  const auto start = clock.now();
  CHECK(clock.now() == start);
  clock.sleep_until(start + Nanoseconds(250));
  CHECK(clock.now() == start + Nanoseconds(250));
}

TEST_CASE("virtual time never goes back") {
  VirtualClock clock;
  clock.sleep_until(Nanoseconds(100));
  clock.sleep_until(Nanoseconds(40));
  CHECK(clock.now() == Nanoseconds(100));
}

TEST_CASE("only the wall clock is real, and it does not go back") {
  VirtualClock virtual_clock;
  WallClock wall;
  CHECK_FALSE(virtual_clock.is_real());
  CHECK(wall.is_real());
  const auto before = wall.now();
  wall.sleep_until(before);
  CHECK(wall.now() >= before);
}

TEST_CASE("seconds become the nearest nanosecond, and back") {
  const std::pair<double, std::int64_t> rows[] = {
      {0, 0},      {0.01, 10'000'000}, {1.5, 1'500'000'000}, {-0.25, -250'000'000},
      {1.4e-9, 1}, {1.6e-9, 2},        {-1.6e-9, -2},        {86400, 86'400'000'000'000}};
  for (const auto& [seconds, nanoseconds] : rows) {
    CHECK(from_seconds(seconds).count() == nanoseconds);
    CHECK(to_seconds(Nanoseconds(nanoseconds)) == Approx(seconds).margin(1e-9));
  }
}
