// Runs that never end although each leaf that is ticked again and again ends: Streett's condition.
// Where equal children change places on the path, a leaf is followed from place to place: E. A.
// Emerson, A. P. Sistla, "Utilizing Symmetry when Model-Checking under Fairness Assumptions", ACM
// TOPLAS 19, 1997.
#pragma once

#include <vector>

#include "verify/graph.h"

namespace lockstep::host {

// A cycle that is fair: no activation of a leaf gets ticks for ever without an end. Empty: there
// is none. In order, from a state of it that a search finds first; the last edge leads back to it.
// Where children change places in it, each round of it is fair, and after some rounds all of them
// are where they were.
std::vector<CycleStep> fair_cycle(const Graph& graph, const EdgeFilter& filter = {});
// The same, fair or not, if there is any.
std::vector<CycleStep> any_cycle(const Graph& graph, const EdgeFilter& filter);

}  // namespace lockstep::host
