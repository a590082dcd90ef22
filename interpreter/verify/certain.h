// A search with the most general leaves finds what is certain of a tree whatever its leaves do, for
// `lockstep check`. Its bound is a number of states and of ticks, so it says the same on every
// machine. It says nothing of a tree that depends on more than its leaves (clocks, start values).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/core/diagnostics.h"
#include "base/core/place.h"
#include "engine/tree.h"

namespace lockstep::host {

struct Certainty {
  NodeIndex node;
  Severity severity;
  std::string message, hint;
};

// Nodes that no behavior ticks (of a subtree, only its root), and that no behavior ends. `places`
// are those of the nodes in their documents.
// Nothing if `stop_signal` is there and returns something else than 0: another thread wants no
// answer.
std::vector<Certainty> certainties_of(const Tree& tree, std::span<const Place> places,
                                      std::function<int()> stop_signal = {});

}  // namespace lockstep::host
