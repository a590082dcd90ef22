#include "verify/labels.h"

#include <algorithm>

#include "engine/resources.h"
#include "engine/ticker.h"

namespace lockstep::host {

std::vector<Holdable> holdable(const Tree& tree) {
  std::vector<Holdable> found;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const bool holds = tree.is_group(node) || compares_progress(synchronization(tree.nodes[node]));
    if (!holds) continue;
    for_each_child(tree, node, [&](NodeIndex child) { found.push_back({node, child}); });
  }
  return found;
}

Labeller::Labeller(const Tree& tree, const LeafModels& models, std::size_t properties)
    : tree_(tree),
      models_(models),
      held_(holdable(tree)),
      properties_(properties),
      bits_((2 * tree.leaves.size() + held_.size() + properties) / 8 + 1) {}

const LabelTable::Bits& Labeller::of(Stepper& stepper) {
  const Ticker& ticker = stepper.ticker();
  const auto marks = stepper.leaves().marks();
  std::ranges::fill(bits_, std::byte{0});
  for (const std::uint32_t leaf : stepper.leaves().touched()) {
    if (!models_.leaves[leaf].ends) continue;
    if (marks[leaf].ended) {
      LabelTable::set(bits_, marks.size() + leaf);
    } else if (marks[leaf].ticked) {
      LabelTable::set(bits_, leaf);
    }
  }
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (is_held(ticker, held_[i])) LabelTable::set(bits_, 2 * marks.size() + i);
  }
  for (std::size_t i = 0; i < properties_; ++i) {
    if (stepper.owes(i)) LabelTable::set(bits_, 2 * marks.size() + held_.size() + i);
  }
  return bits_;
}

// Who waits for resources is held also before it has begun.
bool Labeller::is_held(const Ticker& ticker, const Holdable& it) const {
  if (!is_pool(tree_, it.holder)) return ticker.held(it.child);
  return ticker.ticked(it.child - 1) && waits(limit(ticker, it.child - 1));
}

}  // namespace lockstep::host
