// The coverage that the nodes of a tree can have at all: proved by a search over all behaviors of
// leaves that keep their contract, where one is short enough.
#pragma once

#include <optional>

#include "leaves/leaf_file.h"
#include "scenario/node_coverage.h"

namespace lockstep::host {

// The leaves do what a leaf file allows, or, if it is null, anything that keeps their contract.
// Nothing if the coverage is not known: the search has a limit, and cannot look into nodes of
// plugins.
std::optional<NodeCoverage> possible_coverage(const Tree& tree, const LeafFile* file, double rate);

// The aspects to expect of a node where nothing is proved.
AspectSet usual_aspects(const Tree& tree, NodeIndex node);

}  // namespace lockstep::host
