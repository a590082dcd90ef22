// A simulated humanoid on a wheeled base, without graphics: one world per run, scene by scene; the
// hallway is apart from the leaves that act in it, in seek.hpp. The scenes are those of examples
// and experiments in M. Colledanchise, L. Natale, Analysis and Exploitation of Synchronized
// Parallel Executions in Behavior Trees.
#include "manipulation.hpp"
#include "seek.hpp"
#include "world.hpp"

LOCKSTEP_PLUGIN("r1sim", "1.0", "A simulated humanoid on a wheeled base, scene by scene",
                lockstep::run_context<r1sim::World>(),
                lockstep::leaf<r1sim::PullDoor>(
                    "PullDoor",
                    "Pulls a door open with the arm. Progress is the part of its way that the hand "
                    "has moved; Success at its end. Failure when the door jams: hand and base have "
                    "moved too far apart. A paused hand stands still."),
                lockstep::leaf<r1sim::BackAway>(
                    "BackAway",
                    "Moves the base away from the door that PullDoor opens. Progress is the part "
                    "of its way that is done; Success at its end, Failure when the door jams. A "
                    "paused base stands still."),
                lockstep::leaf<r1sim::EnterHallway>(
                    "EnterHallway",
                    "Puts the robot into a hallway with objects on the floor; Success at once. "
                    "Must come before the other leaves of the hallway."),
                lockstep::leaf<r1sim::Swipe>(
                    "Swipe",
                    "Sweeps the head over the floor of the hallway. It stops at each object until "
                    "that is identified; one that is out of its reach is missed. Progress is the "
                    "part of the hallway swept; Success at its end. A paused head stands still."),
                lockstep::leaf<r1sim::Navigate>(
                    "Navigate",
                    "Drives the base through the hallway. Progress is the part of it driven; "
                    "Success at its end. A paused base stands still."),
                lockstep::leaf<r1sim::MissedAtMost>(
                    "MissedAtMost", "Whether Swipe has missed no more objects than count."),
                lockstep::leaf<r1sim::HoldCart>(
                    "HoldCart",
                    "Holds a cart straight with compliant arms. Perpetual: progress is 1 while the "
                    "cart is near its place, else 0. Failure when it slips away; it never "
                    "succeeds."),
                lockstep::leaf<r1sim::FollowPath>(
                    "FollowPath",
                    "Drives the base along a straight path, the cart in front. Perpetual: progress "
                    "is 1 while the base is near the path, else 0. Success at the path's end. A "
                    "paused base stands still."),
                lockstep::leaf<r1sim::DoTask>(
                    "DoTask",
                    "A manipulation task whose pace changes at random times. Progress is the part "
                    "of it that is done; Success at its end. A paused task stands still."));
