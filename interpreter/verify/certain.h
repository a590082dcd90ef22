// What is certain of a tree whatever its leaves do, for `lockstep check`: from a search with the
// most general leaves. Its bound is a number of states and of ticks, so it says the same on every
// machine. Of a tree that depends on more than its leaves (clocks, start values) it says nothing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "core/place.h"
#include "engine/tree.h"

namespace lockstep::host {

struct Certainty {
  NodeIndex node;
  Severity severity;
  std::string message, hint;
};

// Nodes that no behavior ticks (of a subtree, only its root), and that no behavior ends. `places`
// are those of the nodes in their documents.
std::vector<Certainty> certainties_of(const Tree& tree, std::span<const Place> places);

}  // namespace lockstep::host
