// The door scene: the arm pulls a door open while the base makes room for it. The hand has to stay
// near the body: the door jams when one has moved too far ahead of the other. After the example
// "Door Pulling" in the paper.
#pragma once

#include <limits>
#include <lockstep/leaf.hpp>

#include "part_action.hpp"

namespace r1sim {

// The hand and the base, each on its way.
struct DoorMotion {
  double way = 1;    // m
  double speed = 0;  // m/s
  double moved = 0;  // m
  double pace = 1;   // of the speed
  bool moves = false;
};

class DoorScene {
 public:
  explicit DoorScene(lockstep::Run& run) : run_(run) {}

  // Brings the scene up to now; every leaf calls it first, so that it does not matter which one
  // does so first in a tick, nor how often a tick comes.
  void advance();
  // The door is closed again, and free.
  void close(double slack);
  bool has_jammed() const { return has_jammed_; }

  DoorMotion hand;
  DoorMotion base;
  bool is_told = false;  // that it has jammed

 private:
  lockstep::Run& run_;
  double time_ = 0;
  double slack_ = std::numeric_limits<double>::infinity();  // m
  bool has_jammed_ = false;
};

struct DoorPorts : lockstep::Ports {
  explicit constexpr DoorPorts(const char* mean_speed)
      : speed{this, "speed", mean_speed, "how fast it moves, in the mean", "m/s", at_least(0)} {}

  Input<double> speed;
  Input<double> spread{this, "spread", "0.1", "the speed of a run is off by at most this part",
                       between(0, 1)};
  Input<double> way{this, "way", "1", "how far it moves", "m"};
};

struct PullDoorPorts : DoorPorts {
  constexpr PullDoorPorts() : DoorPorts("0.2") {}

  Input<double> slack{this, "slack",    "0.4", "the door jams when they are further apart",
                      "m",  at_least(0)};
};

struct BackAwayPorts : DoorPorts {
  constexpr BackAwayPorts() : DoorPorts("0.5") {}
};

// The hand or the base.
template <class Ports, DoorMotion DoorScene::*kPart>
class DoorAction : public PartAction<Ports> {
 public:
  using Status = typename lockstep::Action<Ports>::Status;

  void start() override;
  Status tick() override;
  double progress() const override { return motion().moved / motion().way; }
  double set_pace(double factor) override { return motion().pace = factor; }

 protected:
  DoorScene& scene() const;

 private:
  bool& moves() const override { return motion().moves; }
  DoorMotion& motion() const { return scene().*kPart; }
};

class PullDoor : public DoorAction<PullDoorPorts, &DoorScene::hand> {
 public:
  void start() override;
};

using BackAway = DoorAction<BackAwayPorts, &DoorScene::base>;

}  // namespace r1sim
