#include "engine/synchronized.h"

#include "engine/nodes/kinds.h"

namespace lockstep {

Synchronization synchronization(const Node& node) {
  if (node.kind == &kParallelAbsolute) return Synchronization::Absolute;
  if (node.kind == &kParallelRelative) return Synchronization::Relative;
  return Synchronization::None;
}

std::span<const double> child_progress(Ticker& ticker, NodeIndex node) {
  return ticker.child_numbers(node);
}

std::span<const double> barriers(const Tree& tree, NodeIndex node) {
  if (tree.nodes[node].kind != &kParallelAbsolute) return {};
  const Cell& cell = tree.cells[tree.nodes[node].params];
  return std::span(tree.numbers).subspan(cell.list.first, cell.list.count);
}

double delta(const Tree& tree, NodeIndex node) {
  return tree.cells[tree.nodes[node].params].number;
}

}  // namespace lockstep
