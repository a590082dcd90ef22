// What makes a search of a tree large, and what would make it smaller: for who waits for one that
// does not end. From the tree and the leaf model alone.
#pragma once

#include <string>
#include <vector>

#include "leaves/models.h"

namespace lockstep::host {

struct SearchCost {
  std::string what;    // "3 leaves may take any of 20 steps in a tick: T/a, T/b, T/c"
  std::string remedy;  // "write step=\"0..1\" in their rows …"
  double weight = 0;   // the logarithm of the number of states or of ticks that it multiplies with
};

// The largest first, at most three. Nothing that is small.
std::vector<SearchCost> search_costs(const Tree& tree, const LeafModels& models, double rate);

}  // namespace lockstep::host
