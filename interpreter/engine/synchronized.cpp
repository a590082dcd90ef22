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

// Whether a parameter that is never an entry has this of its words.
bool has_choice(const Tree& tree, NodeIndex node, unsigned parameter, std::int64_t wanted) {
  return parameter != HoldingParameters::kNone && cell_of(tree, node, parameter).integer == wanted;
}

// The least progress that a synchronized node holds in this tick.
double held_from(NodeContext& context, NodeIndex node) {
  const double limit = context.state<SynchronizedState>(node).limit;
  if (synchronization(context.node(node)) == Synchronization::Relative)
    return least_above(least_progress(context.child_states<double>(node)) + limit);
  const unsigned at_barrier = holding(context.tree(), node).at_barrier;
  const bool ticks = context.parameter(node, at_barrier).integer == kTicksAtBarrier;
  return absolute::held_from(limit, ticks);
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

bool has_barrier_at_zero(const Tree& tree, NodeIndex node) {
  if (!is_constant(tree, node, Synchronization::Absolute)) return false;
  const Cell& cell = cell_of(tree, node, holding(tree, node).barriers);
  return absolute::begins_at_zero(
      std::span(tree.numbers).subspan(cell.list.first, cell.list.count));
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
  return has_choice(tree, node, holding(tree, node).idle, kIgnoresIdle);
}

bool holds_between(const Tree& tree, NodeIndex node) {
  return has_choice(tree, node, holding(tree, node).hold, kHoldsBetween);
}

bool is_limit_reached(NodeContext& context, NodeIndex node) {
  const Tree& tree = context.tree();
  for (NodeIndex branch = node; branch != 0;) {
    const NodeIndex parent = tree.labels[branch].parent;
    const bool is_of_plugin = tree.labels[parent].type->leaf != nullptr;
    if (is_of_plugin) return false;
    const Member* const member = barrier_member(tree, parent);
    const NodeIndex holder = member != nullptr ? member->group : parent;
    const bool may_hold = compares_progress(synchronization(tree.nodes[holder])) &&
                          holds_between(tree, holder) &&
                          (member == nullptr || !has_passed_barrier(context, parent));
    if (may_hold && context.progress_in_tick(branch, node) >= held_from(context, holder))
      return true;
    branch = parent;
  }
  return false;
}

}  // namespace lockstep::host
