// Nodes for navigation as those of Nav2, and a simulated robot that navigates.
#include "control.hpp"
#include "simulated.hpp"

LOCKSTEP_PLUGIN(
    "nav", "1.0", "Control nodes for navigation, as those of Nav2, and a simulated robot",
    lockstep::leaf<nav::RecoveryNode>(
        "RecoveryNode",
        "Returns the result of its first child, unless that is Failure: then it ticks the second "
        "child, and the first again after that succeeded. Failure when the second child fails or "
        "is "
        "skipped, or when the first fails once more than number_of_retries."),
    lockstep::leaf<nav::PipelineSequence>(
        "PipelineSequence",
        "As Sequence without memory, but a child that runs does not stop the children behind it "
        "that were already reached. Success when the last child succeeds, Failure when any fails; "
        "skipped children do not count."),
    lockstep::leaf<nav::RoundRobin>(
        "RoundRobin",
        "Ticks one child until it completes, and the next one after that, also in its next "
        "activation. Success when that child succeeds; when it fails or is skipped, the next one "
        "is "
        "tried at once. Failure when none is left, Skipped when all were skipped."),
    lockstep::leaf<nav::RateController>(
        "RateController",
        "Starts its child at most hz times a second and is Running in between. A child that runs "
        "is ticked in every tick."),
    lockstep::leaf<nav::ComputePathToPose>("ComputePathToPose",
                                           "Simulated: plans a path to the goal, in one tick."),
    lockstep::leaf<nav::DrivePath>("DrivePath",
                                   "Simulated: drives to the goal, and may get stuck."),
    lockstep::leaf<nav::ClearEntireCostmap>(
        "ClearEntireCostmap", "Simulated: removes what blocks the planner, in one tick."),
    lockstep::leaf<nav::Maneuver>("Spin", "Simulated: turns on the spot, to get free."),
    lockstep::leaf<nav::Maneuver>("BackUp", "Simulated: drives back, to get free."),
    lockstep::run_context<nav::Robot>());
