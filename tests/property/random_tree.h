// Random trees with random leaves for the property tests: the same seed, the same trial.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "property/plan.h"

namespace lockstep::host::test {

// Before a tick, as a leaf would.
struct EntryWrite {
  int tick = 0;
  std::string entry = {};
  std::variant<double, std::string> value = {};
};

struct Trial {
  Plan plan;
  double period = 0.1;  // seconds
  int ticks = 60;       // of the root; a completed root is ticked anew
  int halt_every = 0;   // after so many ticks the owner halts everything; 0 = never
  bool watched = true;  // the progress of every node is asked after each tick
  // It goes through a document, whose checks may refuse it. Else the tree is made as it is.
  bool is_document = false;
  std::vector<EntryWrite> writes = {};
};

// The same trees, of which some nodes pace, with leaves that obey more or less.
Trial paced(Trial trial, std::uint64_t seed);

// What gives all entries of scripts a value.
inline constexpr auto kStart = "x:=0;y:=1";

Trial random_trial(std::uint64_t seed);
// Of many barriers and pools, with members everywhere: a document.
Trial random_group_trial(std::uint64_t seed);

// The trial with something taken away: candidates for a smaller one that fails alike.
std::vector<Trial> smaller_trials(const Trial& trial);

}  // namespace lockstep::host::test
