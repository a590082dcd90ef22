// The nodes for navigation alone, for robots whose leaves have the names that the simulated ones
// have.
#include "control_leaves.hpp"

LOCKSTEP_PLUGIN("nav_control", "1.0",
                "Control nodes and conditions for navigation, as those of Nav2 until Kilted",
                nav::kRecoveryNode, nav::kPipelineSequence, nav::kRoundRobin, nav::kRateController,
                nav::kSpeedController, nav::kDistanceController, nav::kGoalUpdatedController,
                nav::kGoalUpdated, nav::kGlobalUpdatedGoal, nav::kPathExpiringTimer);
