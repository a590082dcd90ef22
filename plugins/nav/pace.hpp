// Decorators that start their child again and again, at a rate or after a distance. In between they
// are Running, so that a PipelineSequence above continues with what it has reached. A child that
// runs is ticked in every tick.
#pragma once

#include "beginning.hpp"
#include "goal.hpp"

namespace nav {

struct RatePorts : lockstep::Ports {
  Input<double> hz{this, "hz", "10", "how often the child is started", "1/s", at_least(0.001)};
};

// A period begins with each success of the child.
class RateController : public Beginning<RatePorts> {
 public:
  Status tick() override;

 private:
  double began_ = 0;  // when the current period did
};

struct SpeedPorts : AnyGoalPorts {
  Input<double> min_rate{this, "min_rate", "0.1", "at the lowest speed", "1/s", at_least(0.001)};
  Input<double> max_rate{this, "max_rate", "1", "at the highest speed", "1/s", at_least(0.001)};
  Input<double> min_speed{this, "min_speed", "0", "the lowest speed", "m/s", at_least(0)};
  Input<double> max_speed{this, "max_speed", "0.5", "the highest speed", "m/s", at_least(0)};
  Input<double> speed{this, "speed", "{speed}", "that of the robot, as its odometry has it", "m/s"};
};

// A period has the rate of the speed at its beginning, the first one max_rate.
class SpeedController : public Beginning<SpeedPorts> {
 public:
  Status tick() override;

 private:
  double rate() const;

  double began_ = 0, period_ = 0;
};

struct DistancePorts : lockstep::Ports {
  Input<double> distance{this, "distance", "1", "after which the child is started again",
                         "m",  at_least(0)};
  Input<std::string> global_frame{this, "global_frame", "map", "not used: x and y have a frame"};
  Input<std::string> robot_base_frame{this, "robot_base_frame", "base_link", "not used"};
  Input<double> x{this, "x", "{x}", "where the robot is, as its odometry has it", "m"};
  Input<double> y{this, "y", "{y}", "where the robot is, as its odometry has it", "m"};
};

class DistanceController : public Beginning<DistancePorts> {
 public:
  Status tick() override;

 private:
  double from_x_ = 0, from_y_ = 0;  // where the distance begins
};

}  // namespace nav
