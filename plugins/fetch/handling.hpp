// Leaves that are about the objects, the arm and the gripper.
#pragma once

#include "timer.hpp"
#include "world.hpp"

namespace fetch {

struct ObjectPorts : lockstep::Ports {
  Input<std::string> object{this, "object", required, "name of the object"};
};

class Holding : public lockstep::Condition<ObjectPorts> {
 public:
  bool check() override;
};

struct ObjectSeenPorts : ObjectPorts {
  Output<std::string> place{this, "place", "where it was seen"};
};

class ObjectSeen : public lockstep::Condition<ObjectSeenPorts> {
 public:
  bool check() override;
};

struct LookForPorts : ObjectPorts {
  Output<std::string> place{this, "place", "where it lies"};
  Input<double> seconds{this, "seconds", "2", "how long it takes", "s"};
};

class LookFor : public TimedAction<LookForPorts> {
 public:
  Status tick() override;
};

struct GraspPorts : ObjectPorts {
  Input<double> seconds{this, "seconds", "2", "how long it takes", "s"};
  Input<double> failure{this, "failure", "0.3", "probability that the gripper misses"};
};

class Grasp : public TimedAction<GraspPorts> {
 public:
  Status tick() override;
};

struct PutDownPorts : lockstep::Ports {
  Input<double> seconds{this, "seconds", "1.5", "how long it takes", "s"};
};

class PutDown : public TimedAction<PutDownPorts> {
 public:
  Status tick() override;
};

struct MoveArmPorts : lockstep::Ports {
  Input<std::string> pose{this, "pose", required, "stow, carry or reach"};
  Input<double> speed{this, "speed", "0.4", "how much of its range the arm moves per second",
                      "1/s"};
};

class MoveArm : public lockstep::Action<MoveArmPorts> {
 public:
  void start() override;
  Status tick() override;
  double progress() const override;

 private:
  double goal_ = 0;
  double way_ = 0;  // from where it started to the goal
};

}  // namespace fetch
