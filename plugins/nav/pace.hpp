// Decorators that start their child again and again, at a rate or after a distance. In between they
// are Running, so that a PipelineSequence above goes on with what it has reached. A child that runs
// is ticked in every tick.
#pragma once

#include "goal.hpp"
#include "last_tick.hpp"

namespace nav {

// The period goes on when the child has completed, also into the next activation, so that a
// PipelineSequence above starts its child again at this rate. It ends with a halt, or with a gap in
// the ticks.
template <class PortsOfNode>
class AtRate : public lockstep::Decorator<PortsOfNode> {
 public:
  using Status = lockstep::Status;
  void halt() override { begin(); }

 protected:
  void begin() { is_first_ = true; }
  Status tick_at(double rate) {
    const double now = this->now();
    if (last_tick_.is_after_gap(this->tick_number())) begin();
    if (is_first_) began_ = now;
    const bool is_due = is_first_ || now - began_ >= 1 / rate - kRounding;
    if (!is_due && this->child_status() != Status::Running) return Status::Running;
    is_first_ = false;
    const Status status = this->tick_child();
    if (status == Status::Success) began_ = now;
    return status;
  }

 private:
  LastTick last_tick_;
  bool is_first_ = true;
  double began_ = 0;  // when the current period did
};

struct RatePorts : lockstep::Ports {
  Input<double> hz{this, "hz", "10", "how often the child is started", "1/s", at_least(0.001)};
};

class RateController : public AtRate<RatePorts> {
 public:
  Status tick() override { return tick_at(hz.get()); }
};

struct SpeedPorts : AnyGoalPorts {
  Input<double> min_rate{this, "min_rate", "0.1", "at the lowest speed", "1/s", at_least(0.001)};
  Input<double> max_rate{this, "max_rate", "1", "at the highest speed", "1/s", at_least(0.001)};
  Input<double> min_speed{this, "min_speed", "0", "the lowest speed", "m/s", at_least(0)};
  Input<double> max_speed{this, "max_speed", "0.5", "the highest speed", "m/s", at_least(0)};
  Input<double> speed{this, "speed", "{speed}", "that of the robot, as its odometry has it", "m/s"};
};

class SpeedController : public AtRate<SpeedPorts> {
 public:
  Status tick() override;

 private:
  double rate() const;
};

struct DistancePorts : lockstep::Ports {
  Input<double> distance{this, "distance", "1", "after which the child is started again",
                         "m",  at_least(0)};
  Input<std::string> global_frame{this, "global_frame", "map", "not used: x and y have a frame"};
  Input<std::string> robot_base_frame{this, "robot_base_frame", "base_link", "not used"};
  Input<double> x{this, "x", "{x}", "where the robot is, as its odometry has it", "m"};
  Input<double> y{this, "y", "{y}", "where the robot is, as its odometry has it", "m"};
};

class DistanceController : public lockstep::Decorator<DistancePorts> {
 public:
  Status tick() override;
  void halt() override { is_first_ = true; }

 private:
  LastTick last_tick_;
  bool is_first_ = true;
  double from_x_ = 0, from_y_ = 0;  // where the way began
};

}  // namespace nav
