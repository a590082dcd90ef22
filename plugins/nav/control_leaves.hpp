// The leaf types of the control nodes, which two plugins have.
#pragma once

#include "control.hpp"

namespace nav {

inline constexpr auto kRecoveryNode = lockstep::leaf<RecoveryNode>(
    "RecoveryNode",
    "Returns the result of its first child, unless that is Failure: then it ticks the second "
    "child, and the first again after that succeeded. Failure when the second child fails or is "
    "skipped, or when the first fails once more than number_of_retries.");
inline constexpr auto kPipelineSequence = lockstep::leaf<PipelineSequence>(
    "PipelineSequence",
    "As Sequence without memory, but a child that runs does not stop the children behind it that "
    "were already reached. Success when the last child succeeds, Failure when any fails; skipped "
    "children do not count.");
inline constexpr auto kRoundRobin = lockstep::leaf<RoundRobin>(
    "RoundRobin",
    "Ticks one child until it completes, and the next one after that, also in its next activation. "
    "Success when that child succeeds; when it fails or is skipped, the next one is tried at once. "
    "Failure when none is left, Skipped when all were skipped.");
inline constexpr auto kRateController =
    lockstep::leaf<RateController>("RateController",
                                   "Starts its child at most hz times a second and is Running in "
                                   "between. A child that runs is ticked in every tick.");

}  // namespace nav
