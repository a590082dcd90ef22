// The paths of nodes: "Main/lift/arm#2", the tree's id and a segment for each node down to it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tree/definition.h"

namespace lockstep::host {

// What makes a node's name unique among its siblings: the second "arm" is "arm#2", or the next
// number that is free. 0: the name is.
std::vector<std::uint32_t> sibling_numbers(const Definition& definition);
// Of each node, by its index.
std::vector<std::string> paths_of(const Definition& definition);

}  // namespace lockstep::host
