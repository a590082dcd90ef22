// The numbers of a synchronized node in one tick, as the engine has them and a recording: the
// progress of its children, and its limit.
#pragma once

#include <cmath>
#include <limits>
#include <span>

#include "base/core/node_type.h"
#include "base/core/status.h"

namespace lockstep::host {

// Stands for the progress of a child that is left out: nobody waits for it, and it is not held.
inline constexpr double kLeftOut = std::numeric_limits<double>::quiet_NaN();

inline bool is_left_out(double progress) {
  return std::isnan(progress);
}

// The least progress of the children that were not left out; 1 if all were.
inline double least_progress(std::span<const double> progress) {
  double least = 1.0;
  for (const double number : progress) {
    if (number < least) least = number;
  }
  return least;
}

// The most progress that a child may have without being held, given the limit and the least
// progress. ParallelAbsolute: the limit is the current barrier, infinity if none is left;
// ParallelRelative: it is delta.
inline double farthest(Synchronization synchronization, double limit, double least) {
  return synchronization == Synchronization::Relative ? least + limit : limit;
}

// At a barrier at 0 a member runs while its child has not begun.
constexpr bool waits_to_begin(Status member, Status child) {
  return member == Status::Running && child == Status::Idle;
}

}  // namespace lockstep::host
