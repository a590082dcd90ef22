#include "groot/tree.h"

#include <fmt/format.h>

#include "groot/document.h"
#include "groot/statuses.h"

namespace lockstep {

Result<GrootTree> groot_tree(const Definition& definition) {
  const std::size_t nodes = definition.nodes[0].end;
  if (nodes > kMostGrootNodes) {
    return problem(
        fmt::format("the tree has {} nodes, and Groot2 can number {}", nodes, kMostGrootNodes),
        "--monitor shows larger trees");
  }
  const auto subtrees = groot_subtrees(definition);
  return GrootTree{groot_document(definition, subtrees), groot_board_keys(definition, subtrees)};
}

}  // namespace lockstep
