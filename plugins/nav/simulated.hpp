// Leaves of a simulated mobile robot, so that a navigation tree can be tried without one.
#pragma once

#include <lockstep/leaf.hpp>

namespace nav {

// Where the robot is, on the path to its goal.
struct Robot {
  static constexpr double kUnknown = -1;
  double left = kUnknown;   // meters to the goal; known after the first path
  bool is_blocked = false;  // something that is not there blocks the costmap
  bool is_stuck = false;    // something that is there blocks the wheels
};

struct GoalPorts : lockstep::Ports {
  Input<double> distance{this, "distance", "10", "to the goal when the run begins", "m"};
  Input<double> failure{this, "failure",    "0.1", "probability that no path is found",
                        "",   between(0, 1)};
  Output<double> path{this, "path", "length of the path", "m"};
};

// Plans in one tick.
class ComputePathToPose : public lockstep::Action<GoalPorts> {
 public:
  Status tick() override;
};

struct FollowPorts : lockstep::Ports {
  Input<double> speed{this, "speed", "0.5", "of the robot", "m/s", at_least(0)};
  Input<double> failure{this, "failure",    "0.02", "probability of getting stuck in a second",
                        "",   between(0, 1)};
};

// Drives until the goal is reached, along the newest path.
class DrivePath : public lockstep::Action<FollowPorts> {
 public:
  void start() override;
  Status tick() override;
  double progress() const override;

 private:
  double whole_ = 0;  // meters to the goal when the activation began
};

// Removes what blocks the costmap; takes one tick.
class ClearEntireCostmap : public lockstep::Action<> {
 public:
  Status tick() override;
};

struct ManeuverPorts : lockstep::Ports {
  Input<double> seconds{this, "seconds", "2", "how long it takes", "s"};
  Input<double> success{this, "success",    "0.7", "probability that the robot is free after it",
                        "",   between(0, 1)};
};

// Spin and BackUp: move until the robot is free again.
class Maneuver : public lockstep::Action<ManeuverPorts> {
 public:
  void start() override { done_ = 0; }
  Status tick() override;
  double progress() const override { return seconds.get() > 0 ? done_ / seconds.get() : 0; }

 private:
  double done_ = 0;  // seconds
};

}  // namespace nav
