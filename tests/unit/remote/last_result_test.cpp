#include "leaves/remote/json_lines/last_result.h"

#include <catch2/catch.hpp>

namespace lockstep::host {

using std::chrono::milliseconds, std::chrono::seconds;

TEST_CASE(
    "the last result of a condition ages with the time of the run, not with that of a pause") {
  LeafTime time{.now = seconds(1), .period = milliseconds(10)};
  LastResult last(time, {});
  last.begin_tick();
  CHECK(last.now() == LOCKSTEP_RUNNING);  // there is none
  // It came early in a pause of half a minute between two ticks.
  time.now += milliseconds(10);
  last.begin_tick();
  last.keep(LOCKSTEP_SUCCESS, seconds(30));
  CHECK(last.now() == LOCKSTEP_SUCCESS);
  // Five periods later it is as old as it may be.
  time.now += milliseconds(40);
  last.begin_tick();
  CHECK(last.now() == LOCKSTEP_SUCCESS);
  time.now += milliseconds(1);
  CHECK(last.now() == LOCKSTEP_RUNNING);
  // One that came while nobody asked is as old as it is.
  time.now += seconds(2);
  last.begin_tick();
  last.keep(LOCKSTEP_FAILURE, milliseconds(30));
  CHECK(last.now() == LOCKSTEP_FAILURE);
  last.keep(LOCKSTEP_FAILURE, seconds(1));
  CHECK(last.now() == LOCKSTEP_RUNNING);
}

}  // namespace lockstep::host
