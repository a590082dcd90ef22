// The leaf types of the nodes for navigation, which three plugins have.
#pragma once

#include "control.hpp"
#include "goal.hpp"
#include "pace.hpp"

namespace nav {

inline constexpr auto kRecoveryNode = lockstep::leaf<RecoveryNode>(
    "RecoveryNode",
    "Returns the result of its first child, unless that is Failure: then it ticks the second "
    "child, and the first again after that succeeded. Failure when the second child fails or is "
    "skipped, or when the first fails once more than number_of_retries. The number of retries "
    "begins again with each activation, except after a skipped recovery.");
inline constexpr auto kPipelineSequence = lockstep::leaf<PipelineSequence>(
    "PipelineSequence",
    "As Sequence without memory, but a child that runs does not stop the children behind it that "
    "were already reached. A completed action keeps its result until the node completes; another "
    "completed child begins again. Success when the last child succeeds, Failure when any fails; "
    "skipped children do not count.");
inline constexpr const char* kRoundRobinDoc =
    "Ticks one child until it completes, and the next one after that, also in its next activation. "
    "Success when that child succeeds; when it fails or is skipped, the next one is tried at once. "
    "Failure when all have failed, Skipped when all were skipped. Without wrap_around the last "
    "child "
    "ends the round: Failure, whatever it returns.";
inline constexpr auto kRoundRobin = lockstep::leaf<RoundRobin<true>>("RoundRobin", kRoundRobinDoc);
inline constexpr auto kRoundRobinOfLyrical =
    lockstep::leaf<RoundRobin<false>>("RoundRobin", kRoundRobinDoc);
inline constexpr auto kRateController = lockstep::leaf<RateController>(
    "RateController",
    "Starts its child, and again 1/hz after each Success. Running in "
    "between. A child that runs is ticked in every tick.");
inline constexpr auto kSpeedController = lockstep::leaf<SpeedController>(
    "SpeedController",
    "Starts its child at min_rate to max_rate times a second, as the speed is between min_speed "
    "and max_speed when a period begins; the first period has max_rate. At once for another goal. "
    "Running in between. A child that runs is ticked in every tick.");
inline constexpr auto kDistanceController = lockstep::leaf<DistanceController>(
    "DistanceController",
    "Starts its child whenever the robot is so far from where it was at the child's last Success. "
    "Running in between. A child that runs is ticked in every tick.");
inline constexpr auto kGoalUpdatedController = lockstep::leaf<GoalUpdatedController>(
    "GoalUpdatedController",
    "Starts its child at once, and again whenever the goal has changed. Running in between. A "
    "child "
    "that runs is ticked in every tick, also for another goal, which it sees itself.");
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
