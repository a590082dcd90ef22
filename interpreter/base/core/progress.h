// Comparing progress, and other numbers that are sums of doubles.
#pragma once

namespace lockstep::host {

// What differs by no more is the same, wherever progress is compared: at barriers, in properties,
// scenarios, proofs and views. Else a child after ten steps of 0.1, at 0.9999999999999999, would
// wait at a barrier at 1.
inline constexpr double kProgressEpsilon = 1e-9;

}  // namespace lockstep::host
