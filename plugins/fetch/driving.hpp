// Leaves that are about the base and the doors in its way.
#pragma once

#include <cstddef>

#include "timer.hpp"
#include "world.hpp"

namespace fetch {

struct PlacePorts : lockstep::Ports {
  Input<std::string> place{this, "place", required, "name of the place"};
};

class At : public lockstep::Condition<PlacePorts> {
 public:
  bool check() override;
};

struct DoorPorts : lockstep::Ports {
  Input<std::string> door{this, "door", required, "the room that it leads to"};
};

class DoorOpen : public lockstep::Condition<DoorPorts> {
 public:
  bool check() override;
};

struct OpenDoorPorts : DoorPorts {
  Input<double> seconds{this, "seconds", "3", "how long it takes", "s"};
  Input<double> failure{this, "failure", "0.2", "probability that the handle slips"};
};

class OpenDoor : public TimedAction<OpenDoorPorts> {
 public:
  Status tick() override;
};

struct DriveToPorts : PlacePorts {
  Input<double> speed{this, "speed", "0.8", "speed of the base", "m/s"};
};

class DriveTo : public lockstep::Action<DriveToPorts> {
 public:
  void start() override;
  Status tick() override;
  double progress() const override;

 private:
  bool advance(World& world, double step);
  double length_left(const World& world) const;

  std::vector<Waypoint> route_;
  std::size_t next_ = 0;  // in route_
  double length_ = 0;     // of the whole route, in m
};

}  // namespace fetch
