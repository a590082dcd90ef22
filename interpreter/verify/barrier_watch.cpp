#include "verify/barrier_watch.h"

#include <algorithm>

#include "engine/synchronized.h"

namespace lockstep::host {
namespace {

// A robot that runs a tree of its own is waited for, and not held here.
bool may_hold(const Tree& tree, NodeIndex node, NodeIndex child) {
  const bool holds_first = tree.labels[node].type->holds_first_child;
  return tree.nodes[child].is_guard == 0 && (!holds_first || child == node + 1);
}

}  // namespace

BarrierWatch::BarrierWatch(const Tree& tree, const ModelLeaves& leaves)
    : tree_(tree), leaves_(leaves) {
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const auto list = barriers(tree, node);
    if (!list || list->empty()) continue;
    Barriers it{.node = node,
                .list = {list->begin(), list->end()},
                .ticks_at_barrier = ticks_at_barrier(tree, node),
                .is_group = tree.is_group(node),
                .children = {}};
    for_each_child(tree, node, [&](NodeIndex child) {
      const bool is_leaf = tree.labels[child].type->leaf != nullptr;
      it.children.push_back({.node = child,
                             .is_held = may_hold(tree, node, child),
                             .leaf = is_leaf ? tree.nodes[child].params : kNoLeaf,
                             .reached = {},
                             .may_pass = false});
    });
    barriers_.push_back(std::move(it));
  }
}

void BarrierWatch::before_tick(Ticker& ticker) {
  for (Barriers& it : barriers_) {
    it.is_looked_at = it.is_group || ticker.status(it.node) == Status::Running;
    if (!it.is_looked_at) continue;
    for (Child& child : it.children) look_at(ticker, it, child);
  }
}

// Of a group, only members that run count: another one may have had its passage.
void BarrierWatch::look_at(Ticker& ticker, const Barriers& of, Child& child) const {
  const Status status = ticker.status(child.node);
  child.reached.reset();
  child.may_pass = child.is_held;
  if (of.is_group) {
    const NodeIndex member = tree_.labels[child.node].parent;
    if (status != Status::Running || has_passed_barrier(ticker, member)) return;
  } else if (status == Status::Skipped) {
    return;
  } else if (status == Status::Success || status == Status::Failure) {
    const bool is_there = status == Status::Success || tree_.nodes[child.node].is_latched != 0;
    child.reached = is_there ? 1.0 : 0.0;
    child.may_pass = false;
    return;
  }
  child.reached = status == Status::Running ? progress(ticker, child) : 0.0;
}

// A leaf that has to begin again has none.
double BarrierWatch::progress(Ticker& ticker, const Child& child) const {
  if (child.leaf == kNoLeaf) return ticker.progress(child.node);
  return leaves_.states()[child.leaf].runs() ? leaves_.progress(child.leaf) : 0.0;
}

void BarrierWatch::after_tick(const Ticker& ticker) {
  passed_.reset();
  for (const Barriers& it : barriers_) {
    if (it.is_looked_at && !passed_) compare(ticker, it);
  }
}

void BarrierWatch::compare(const Ticker& ticker, const Barriers& of) {
  constexpr double kClearly = 1e-6;
  const Child* late = nullptr;
  for (const Child& it : of.children) {
    if (it.reached && (late == nullptr || *it.reached < *late->reached)) late = &it;
  }
  if (late == nullptr) return;
  for (const double barrier : of.list) {
    if (*late->reached > barrier - kClearly) continue;
    const double from = of.ticks_at_barrier ? barrier + kClearly : barrier;
    for (const Child& it : of.children) {
      if (!it.may_pass || !it.reached || *it.reached < from || !ticker.ticked(it.node)) continue;
      passed_ = Passed{of.node, it.node, late->node, barrier};
      return;
    }
  }
}

}  // namespace lockstep::host
