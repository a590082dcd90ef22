#include "engine/synchronized.h"

#include <algorithm>

namespace lockstep {
namespace {

bool is_constant(const Tree& tree, NodeIndex node, Synchronization wanted) {
  if (synchronization(tree.nodes[node]) != wanted) return false;
  return !std::ranges::binary_search(tree.bound, node, {}, &BoundNode::node);  // in pre-order
}

}  // namespace

std::optional<std::span<const double>> barriers(const Tree& tree, NodeIndex node) {
  if (!is_constant(tree, node, Synchronization::Absolute)) return std::nullopt;
  const Cell& cell = tree.cells[tree.nodes[node].params];
  return std::span(tree.numbers).subspan(cell.list.first, cell.list.count);
}

std::optional<double> delta(const Tree& tree, NodeIndex node) {
  if (!is_constant(tree, node, Synchronization::Relative)) return std::nullopt;
  return tree.cells[tree.nodes[node].params].number;
}

}  // namespace lockstep
