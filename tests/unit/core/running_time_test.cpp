#include "base/core/running_time.h"

#include <catch2/catch.hpp>

namespace lockstep::host::test {
namespace {

using namespace std::chrono_literals;

TEST_CASE("looks that come in time add up to the time") {
  RunningTime time(10ms, 5s);
  CHECK(time.look(5s + 10ms) == 10ms);
  CHECK(time.look(5s + 10ms) == 0ms);
  CHECK(time.look(5s + 29ms) == 19ms);
}

TEST_CASE("a look that comes late counts as two intervals, and no more") {
  RunningTime time(10ms, 5s);
  CHECK(time.look(9s) == 20ms);
  CHECK(time.look(9s + 3ms) == 3ms);
}

TEST_CASE("a limit is looked at eight times, every 0.1 s at least and every 0.01 s at most") {
  CHECK(RunningTime::interval_for(400ms) == 50ms);
  CHECK(RunningTime::interval_for(10s) == 100ms);
  CHECK(RunningTime::interval_for(1ms) == 10ms);
}

}  // namespace
}  // namespace lockstep::host::test
