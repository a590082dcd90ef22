// What the leaves of one run share: each scene's part of the world.
#pragma once

#include "cart.hpp"

namespace r1sim {

struct World {
  explicit World(lockstep::Run& run) : cart(run) {}

  CartScene cart;
};

}  // namespace r1sim
