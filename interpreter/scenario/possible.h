// What can be seen of the nodes of a tree at all: proved by a search over all behaviors of leaves
// that keep their contract, where one is short enough.
#pragma once

#include <optional>

#include "leaves/leaf_file.h"
#include "scenario/node_coverage.h"

namespace lockstep::host {

// Of leaves that do what a leaf file allows, or, if it is null, any that keep their contract.
// Nothing if it is not known: the search has a limit, and cannot look into nodes of plugins.
std::optional<NodeCoverage> possible_coverage(const Tree& tree, const LeafFile* file, double rate);

// What to expect of a node where nothing is proved.
AspectSet usual_aspects(const Tree& tree, NodeIndex node);

}  // namespace lockstep::host
