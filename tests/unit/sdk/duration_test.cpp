#include "lockstep/duration.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <ratio>

using namespace std::chrono;
using lockstep::bounded;
using lockstep::kLongestWait;

TEST_CASE("what is too long for a clock is the longest wait") {
  CHECK(bounded(hours::max()) == kLongestWait);
  CHECK(bounded(nanoseconds::max()) == kLongestWait);
  CHECK(bounded(duration<double>(std::numeric_limits<double>::infinity())) == kLongestWait);
  CHECK(bounded(duration<double>(1e12)) == kLongestWait);
  CHECK(bounded(duration<float, std::ratio<86400>>(1e9F)) == kLongestWait);
  CHECK(steady_clock::now() + bounded(hours::max()) > steady_clock::now());
  CHECK(system_clock::now() + bounded(hours::max()) > system_clock::now());
}

TEST_CASE("a wait of less than nothing is none") {
  CHECK(bounded(hours::min()) == nanoseconds(0));
  CHECK(bounded(duration<double>(-1e-9)) == nanoseconds(0));
  CHECK(bounded(duration<double>(std::numeric_limits<double>::quiet_NaN())) == nanoseconds(0));
}

TEST_CASE("any other wait is as long as it was") {
  CHECK(bounded(milliseconds(10)) == milliseconds(10));
  CHECK(bounded(duration<double>(0.25)) == milliseconds(250));
  CHECK(bounded(kLongestWait - hours(1)) == kLongestWait - hours(1));
}
