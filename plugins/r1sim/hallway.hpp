// The hallway scene: the head sweeps the floor before the robot from side to side and stops at each
// object until it is identified; the base drives. The head can look no further than its reach from
// the middle of its view, which moves with the base. seek.hpp has the leaves that act in it.
#pragma once

#include <cstdint>
#include <lockstep/leaf.hpp>
#include <vector>

namespace r1sim {

struct HallwayObject {
  double place = 0;    // m along the hallway
  double side = 0;     // across it: -1 left, 1 right
  double seconds = 0;  // that its identification takes
  double found = 0;    // m swept when the head passes it
};

struct Hallway {
  double length = 0;  // m
  std::int64_t objects = 0;
  double identify_min = 0, identify_max = 0;  // s
};

struct Head {
  double speed = 1;    // m of hallway swept per second
  double stripe = 1;   // m of hallway for each sweep from one side to the other
  double reach = 0;    // m before and behind the middle of the view
  double swept = 0;    // m
  bool moves = false;  // else it stands, and identifies nothing
};

struct Base {
  double speed = 0;     // m/s
  double traveled = 0;  // m, of the middle of the view
  bool moves = false;
};

class HallwayScene {
 public:
  explicit HallwayScene(lockstep::Run& run) : run_(run) {}

  // Puts objects at random places; they depend on nothing but the seed and this hallway.
  void furnish(const Hallway& hallway);
  // The head begins at the hallway's start, and has identified nothing.
  void begin_sweep(const Head& head);
  // Brings the scene up to now; every leaf calls it first, so that it does not matter which one
  // does so first in a tick, nor how often a tick comes.
  void advance();

  double length() const { return length_; }  // 0 = there is no hallway yet
  std::int64_t identified() const { return identified_; }
  std::int64_t missed() const { return missed_; }

  Head head;
  Base base;

 private:
  void sweep(double seconds);
  // Looks at it. If it is identified or missed by now, what is left of the seconds is for others.
  bool is_settled(const HallwayObject& object, double& seconds);

  lockstep::Run& run_;
  double time_ = 0;
  double length_ = 0;
  std::vector<HallwayObject> objects_;  // in the order in which the head passes them
  std::size_t next_ = 0;
  double looked_ = 0;  // s, at the next object
  std::int64_t identified_ = 0;
  std::int64_t missed_ = 0;
};

}  // namespace r1sim
