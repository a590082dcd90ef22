// The world that the leaves of one run share, with a part for each scene.
#pragma once

#include "cart.hpp"
#include "door.hpp"
#include "hallway.hpp"

namespace r1sim {

struct World {
  explicit World(lockstep::Run& run) : cart(run), door(run), hallway(run) {}

  CartScene cart;
  DoorScene door;
  HallwayScene hallway;
};

}  // namespace r1sim
