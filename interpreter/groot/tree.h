// Groot2's picture of a tree: its document, and the keys of its blackboards.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "groot/board_keys.h"
#include "tree/definition.h"

namespace lockstep::host {

struct GrootTree {
  std::string document;
  std::vector<std::uint32_t> order;  // of the nodes in the document
  std::vector<GrootBoardKeys> boards;
};

// Refuses a tree with more nodes than the protocol has numbers for.
Result<GrootTree> groot_tree(const Definition& definition);

}  // namespace lockstep::host
