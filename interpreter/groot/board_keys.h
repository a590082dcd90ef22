// The names by which each subtree knows the entries of the blackboard.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "groot/subtrees.h"

namespace lockstep::host {

// The keys of one subtree.
struct GrootBoardKeys {
  std::string name;        // of the subtree
  std::uint32_t node = 0;  // its SubTree node; none: the first one is the main tree's
  std::map<std::string, std::uint32_t, std::less<>> slots = {};  // by key
};

// In the order of the subtrees.
std::vector<GrootBoardKeys> groot_board_keys(const Definition& definition,
                                             std::span<const GrootSubtree> subtrees);

}  // namespace lockstep::host
