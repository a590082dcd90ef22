// What the leaves of one run share: each scene's part of the world.
#pragma once

#include "cart.hpp"
#include "hallway.hpp"

namespace r1sim {

struct World {
  explicit World(lockstep::Run& run) : cart(run), hallway(run) {}

  CartScene cart;
  HallwayScene hallway;
};

}  // namespace r1sim
