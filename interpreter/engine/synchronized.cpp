#include "engine/synchronized.h"

#include <algorithm>

#include "engine/leaf_loop.h"
#include "engine/nodes/barrier_list.h"

namespace lockstep::host {
namespace {

const HoldingParameters& holding(const Tree& tree, NodeIndex node) {
  return tree.labels[node].type->holding;
}

bool is_constant(const Tree& tree, NodeIndex node, Synchronization wanted) {
  return synchronization(tree.nodes[node]) == wanted && bound_of(tree, node) == nullptr;
}

}  // namespace

const Cell& cell_of(const Tree& tree, NodeIndex node, unsigned parameter) {
  return tree.cells[tree.nodes[node].params + parameter];
}

const BoundNode* bound_of(const Tree& tree, NodeIndex node) {
  const auto it = std::ranges::lower_bound(tree.bound, node, {}, &BoundNode::node);  // in pre-order
  return it != tree.bound.end() && it->node == node ? &*it : nullptr;
}

std::vector<NodeIndex> synchronized_nodes(const Tree& tree) {
  std::vector<NodeIndex> nodes;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (synchronization(tree.nodes[node]) != Synchronization::None) nodes.push_back(node);
  }
  return nodes;
}

std::vector<NodeIndex> children_of(const Tree& tree, NodeIndex node) {
  std::vector<NodeIndex> children;
  for_each_child(tree, node, [&](NodeIndex child) { children.push_back(child); });
  return children;
}

double snapshot_of(NodeContext& context, NodeIndex child) {
  double progress = 0, least = 1;
  if (LeafLoop::read_progress(context, child, child + 1, &progress, least) != child) {
    return progress;
  }
  const Activity activity = context.activity(child);
  if (activity == Activity::Skipped) return kLeftOut;
  if (activity == Activity::Failure && context.is_latched(child)) return 1.0;
  return context.progress(child);
}

OutermostHold hold_of(const RunView& run, NodeIndex held) {
  const auto parent_of = [&](NodeIndex node) { return run.tree().labels[node].parent; };
  while (run.held(parent_of(held)) && parent_of(held) != held) held = parent_of(held);
  return {parent_of(held), held};
}

bool is_held_by_parallel(const RunView& run, NodeIndex node) {
  return run.held(node) && compares_progress(synchronization(run.node(hold_of(run, node).holder)));
}

const Member* barrier_member(const Tree& tree, NodeIndex node) {
  const auto it = std::ranges::find(tree.members, node, &Member::node);
  if (it == tree.members.end()) return nullptr;
  return compares_progress(synchronization(tree.nodes[it->group])) ? &*it : nullptr;
}

std::optional<std::span<const double>> barriers(const Tree& tree, NodeIndex node) {
  if (!is_constant(tree, node, Synchronization::Absolute)) return std::nullopt;
  const Cell& cell = cell_of(tree, node, holding(tree, node).barriers);
  const auto list = std::span(tree.numbers).subspan(cell.list.first, cell.list.count);
  return absolute::begins_at_zero(list) ? list.subspan(1) : list;
}

std::uint32_t entry_of_barriers(const Tree& tree, NodeIndex node) {
  return tree.ports[bound_of(tree, node)->first_port + holding(tree, node).barriers].slot;
}

bool ticks_at_barrier(const Tree& tree, NodeIndex node) {
  return cell_of(tree, node, holding(tree, node).at_barrier).integer == kTicksAtBarrier;
}

std::optional<double> delta(const Tree& tree, NodeIndex node) {
  if (!is_constant(tree, node, Synchronization::Relative)) return std::nullopt;
  return cell_of(tree, node, holding(tree, node).delta).number;
}

bool ignores_idle(const Tree& tree, NodeIndex node) {
  const unsigned place = holding(tree, node).idle;
  if (place == HoldingParameters::kNone) return false;
  if (const BoundNode* bound = bound_of(tree, node)) {
    return tree.constants[tree.ports[bound->first_port + place].constant] == Value("ignore");
  }
  return cell_of(tree, node, place).integer == kIgnoresIdle;
}

}  // namespace lockstep::host
