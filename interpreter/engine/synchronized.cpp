#include "engine/synchronized.h"

namespace lockstep {

std::span<const double> barriers(const Tree& tree, NodeIndex node) {
  if (synchronization(tree.nodes[node]) != Synchronization::Absolute) return {};
  const Cell& cell = tree.cells[tree.nodes[node].params];
  return std::span(tree.numbers).subspan(cell.list.first, cell.list.count);
}

double delta(const Tree& tree, NodeIndex node) {
  return tree.cells[tree.nodes[node].params].number;
}

}  // namespace lockstep
