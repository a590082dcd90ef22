// The control nodes alone, for robots whose leaves have the names that the simulated ones have.
#include "control_leaves.hpp"

LOCKSTEP_PLUGIN("nav_control", "1.0", "Control nodes for navigation, as those of Nav2",
                nav::kRecoveryNode, nav::kPipelineSequence, nav::kRoundRobin, nav::kRateController);
