// Nodes for navigation as those of Nav2, and a simulated robot that navigates.
#include "control_leaves.hpp"
#include "simulated.hpp"

LOCKSTEP_PLUGIN(
    "nav", "1.0", "Control nodes for navigation, as those of Nav2, and a simulated robot",
    nav::kRecoveryNode, nav::kPipelineSequence, nav::kRoundRobin, nav::kRateController,
    nav::kSpeedController, nav::kDistanceController, nav::kGoalUpdatedController, nav::kGoalUpdated,
    nav::kGlobalUpdatedGoal, nav::kPathExpiringTimer,
    lockstep::leaf<nav::ComputePathToPose>("ComputePathToPose",
                                           "Simulated: plans a path to the goal, in one tick."),
    lockstep::leaf<nav::DrivePath>("DrivePath",
                                   "Simulated: drives to the goal, and may get stuck."),
    lockstep::leaf<nav::ClearEntireCostmap>(
        "ClearEntireCostmap", "Simulated: removes what blocks the planner, in one tick."),
    lockstep::leaf<nav::Maneuver>("Spin", "Simulated: turns on the spot, to get free."),
    lockstep::leaf<nav::Maneuver>("BackUp", "Simulated: drives back, to get free."),
    lockstep::run_context<nav::Robot>());
