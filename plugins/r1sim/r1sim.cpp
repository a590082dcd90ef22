// A simulated humanoid on a wheeled base, without graphics: one world per run, one pair of files
// per scene. The scenes are those of the experiments in M. Colledanchise, L. Natale, Analysis and
// Exploitation of Synchronized Parallel Executions in Behavior Trees.
#include "world.hpp"

LOCKSTEP_PLUGIN("r1sim", "1.0", "A simulated humanoid on a wheeled base, scene by scene",
                lockstep::run_context<r1sim::World>(),
                lockstep::leaf<r1sim::HoldCart>(
                    "HoldCart",
                    "Holds a cart straight with compliant arms. Perpetual: progress is 1 while the "
                    "cart is near its place, else 0. Failure when it slips away, Success when "
                    "FollowPath has arrived and the cart is near its place."),
                lockstep::leaf<r1sim::FollowPath>(
                    "FollowPath",
                    "Drives the base along a straight path, the cart in front. Perpetual: progress "
                    "is 1 while the base is near the path, else 0. Success at the path's end. A "
                    "paused base stands still."));
