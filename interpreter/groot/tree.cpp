#include "groot/tree.h"

#include <fmt/format.h>

#include <utility>

#include "groot/document.h"
#include "groot/statuses.h"

namespace lockstep::host {

Result<GrootTree> groot_tree(const Definition& definition) {
  const std::size_t nodes = definition.nodes[0].end;
  if (nodes > kMostGrootNodes) {
    return problem(fmt::format("the tree has {} nodes, and Groot2 can number {} of them", nodes,
                               kMostGrootNodes),
                   "--monitor shows larger trees");
  }
  const auto subtrees = groot_subtrees(definition);
  std::vector<std::uint32_t> order;
  for (const GrootSubtree& it : subtrees) {
    for_each_node(definition, it, [&](std::uint32_t node) { order.push_back(node); });
  }
  return GrootTree{groot_document(definition, subtrees), std::move(order),
                   groot_board_keys(definition, subtrees)};
}

}  // namespace lockstep::host
