// The progress of what takes a time: a Wait, a mock, the leaf of a scenario that has a time.
#pragma once

#include <algorithm>

#include "base/core/deadlines.h"

namespace lockstep::host {

// 1 when all of the time has passed, and of what takes none. Two that began in the same tick and
// take the same time have the same progress in each tick. `passed`: Deadlines::between. A tick of
// 30 Hz is 1/6 of 0.2 s, so that what is to stop at 1/6 does.
inline double progress_of_time(Nanoseconds passed, Nanoseconds all, const Deadlines& deadlines) {
  return all.count() > 0 ? std::min(1.0, deadlines.seconds_of(passed) / to_seconds(all)) : 1.0;
}

}  // namespace lockstep::host
