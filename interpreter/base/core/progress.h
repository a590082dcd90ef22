// Comparing progress, and other numbers that are sums of doubles.
#pragma once

namespace lockstep::host {

// What differs by no more is the same, wherever progress is compared: at barriers, in properties,
// scenarios, proofs and views. Else a child after ten steps of 0.1, at 0.9999999999999999, would
// wait at a barrier at 1.
inline constexpr double kProgressEpsilon = 1e-9;

// The least progress that has reached a barrier, and a number in a script. From 0.499999999 on,
// which in doubles is more than 1e-9 from it, 0.5 is reached.
inline double reached_from(double number) {
  return number - kProgressEpsilon;
}

}  // namespace lockstep::host
