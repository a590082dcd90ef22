// The leaf types of the nodes for navigation, which two plugins have.
#pragma once

#include "control.hpp"
#include "goal.hpp"
#include "pace.hpp"

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
inline constexpr auto kSpeedController = lockstep::leaf<SpeedController>(
    "SpeedController",
    "Starts its child at min_rate to max_rate times a second, as the speed is between min_speed "
    "and max_speed, and at once for another goal. Running in between. A child that runs is ticked "
    "in every tick.");
inline constexpr auto kDistanceController = lockstep::leaf<DistanceController>(
    "DistanceController",
    "Starts its child whenever the robot is so far from where it was at the child's last Success. "
    "Running in between. A child that runs is ticked in every tick.");
inline constexpr auto kGoalUpdatedController = lockstep::leaf<GoalUpdatedController>(
    "GoalUpdatedController",
    "Starts its child at once, and again whenever the goal has changed; a child that still runs is "
    "halted first. Running in between.");
inline constexpr auto kGoalUpdated = lockstep::leaf<GoalUpdated>(
    "GoalUpdated",
    "Whether the goal has changed since the last tick of this node. It begins again, with Failure, "
    "when it was not ticked in the tick before.");
inline constexpr auto kGlobalUpdatedGoal = lockstep::leaf<GlobalUpdatedGoal>(
    "GlobalUpdatedGoal",
    "Whether the goal has changed since the last tick of this node, however long ago that was. "
    "Success in its first tick.");
inline constexpr auto kPathExpiringTimer = lockstep::leaf<PathExpiringTimer>(
    "PathExpiringTimer",
    "Success when the path has been the same for so many seconds, and Failure until then and after "
    "it. Another path begins the time again.");

}  // namespace nav
