// Simulated time: the topic /clock, for `--clock ros` and for stamps.
#pragma once

#include <lockstep/ext/clock.h>

#include <cstdint>

namespace ros2 {

const lockstep_clock& ros_clock();

// Nanoseconds of /clock where the run goes by it; else of the system.
std::int64_t ros_now();

}  // namespace ros2
