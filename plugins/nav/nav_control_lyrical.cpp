// The nodes for navigation with the defaults that they have in Nav2 since Lyrical.
#include "control_leaves.hpp"

LOCKSTEP_PLUGIN("nav_control_lyrical", "1.0",
                "Control nodes and conditions for navigation, as those of Nav2 since Lyrical",
                nav::kRecoveryNode, nav::kPipelineSequence, nav::kRoundRobinOfLyrical,
                nav::kRateController, nav::kSpeedController, nav::kDistanceController,
                nav::kGoalUpdatedController, nav::kGoalUpdated, nav::kGlobalUpdatedGoal,
                nav::kPathExpiringTimer);
