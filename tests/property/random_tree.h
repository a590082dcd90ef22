// Random trees with random leaves for the property tests: the same seed, the same trial.
#pragma once

#include <cstdint>

#include "property/plan.h"

namespace lockstep::test {

struct Trial {
  Plan plan;
  double period = 0.1;  // seconds
  int ticks = 60;       // of the root; a completed root is ticked anew
  int halt_every = 0;   // after so many ticks the owner halts everything; 0 = never
  bool watched = true;  // the progress of every node is asked after each tick
};

Trial random_trial(std::uint64_t seed);

// The trial with something taken away: candidates for a smaller one that fails alike.
std::vector<Trial> smaller_trials(const Trial& trial);

}  // namespace lockstep::test
