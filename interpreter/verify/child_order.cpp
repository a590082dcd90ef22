#include "verify/child_order.h"

#include <algorithm>
#include <numeric>

namespace lockstep::host {
namespace {

// The phase of a leaf follows from the activity of its node, but for whether it was cut.
std::uint64_t key_of(Activity activity, const LeafState& leaf) {
  return std::uint64_t{leaf.phase == Phase::Cut} << 56u |
         std::uint64_t{static_cast<std::uint8_t>(activity)} << 48u |
         std::uint64_t{leaf.level} << 32u | leaf.ticks;
}

template <class T>
void reorder(std::vector<T>& values, std::vector<T>& before, std::uint32_t first,
             std::uint32_t from, std::uint32_t size) {
  std::copy_n(before.begin() + from, size, values.begin() + first);
}

}  // namespace

ChildOrder::ChildOrder(const Tree& tree, const Symmetry& symmetry)
    : tree_(tree), symmetry_(symmetry), origins_(tree.nodes.size()) {
  std::iota(origins_.begin(), origins_.end(), NodeIndex{0});
}

void ChildOrder::put_back() {
  if (has_moved_) std::iota(origins_.begin(), origins_.end(), NodeIndex{0});
  has_moved_ = false;
}

void ChildOrder::sort(KeptState& state) {
  put_back();
  symmetry_.number_kept_children(tree_, state.words, Symmetry::Numbered::FromNode);
  for (const EqualChildren& it : symmetry_.classes()) {
    const bool is_sorted = it.are_leaves() ? sort_leaves(it, state) : sort_subtrees(it, state);
    if (!is_sorted) apply(it, state);
  }
  symmetry_.number_kept_children(tree_, state.words, Symmetry::Numbered::InTree);
}

// Fills `order_`, unless they are in order.
bool ChildOrder::sort_leaves(const EqualChildren& it, const KeptState& state) {
  keys_.clear();
  for (std::uint32_t i = 0; i < it.places.size(); ++i) {
    const EqualChildren::Place& place = it.places[i];
    keys_.emplace_back(key_of(state.activity[place.node], state.leaves[place.leaf]), i);
  }
  if (std::ranges::is_sorted(keys_)) return true;
  std::ranges::sort(keys_);
  order_.clear();
  for (const auto& [key, place] : keys_) order_.push_back(place);
  return false;
}

bool ChildOrder::sort_subtrees(const EqualChildren& it, const KeptState& state) {
  const auto compare = [&](std::uint32_t one, std::uint32_t other) {
    const EqualChildren::Place &a = it.places[one], &b = it.places[other];
    for (std::uint32_t i = 0; i < it.nodes; ++i) {
      const auto order = state.activity[a.node + i] <=> state.activity[b.node + i];
      if (order != 0) return order;
    }
    for (std::uint32_t i = 0; i < it.words; ++i) {
      const auto order = state.words[a.word + i] <=> state.words[b.word + i];
      if (order != 0) return order;
    }
    for (std::uint32_t i = 0; i < it.leaves; ++i) {
      const auto order = key_of(Activity::Idle, state.leaves[a.leaf + i]) <=>
                         key_of(Activity::Idle, state.leaves[b.leaf + i]);
      if (order != 0) return order;
    }
    return one <=> other;
  };
  const auto is_before = [&](std::uint32_t one, std::uint32_t other) {
    return compare(one, other) < 0;
  };
  order_.resize(it.places.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (std::ranges::is_sorted(order_, is_before)) return true;
  std::ranges::sort(order_, is_before);
  return false;
}

void ChildOrder::apply(const EqualChildren& it, KeptState& state) {
  has_moved_ = true;
  before_ = state;
  origins_before_ = origins_;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const EqualChildren::Place &to = it.places[i], &from = it.places[order_[i]];
    if (order_[i] == i) continue;
    reorder(state.activity, before_.activity, to.node, from.node, it.nodes);
    reorder(state.words, before_.words, to.word, from.word, it.words);
    reorder(state.leaves, before_.leaves, to.leaf, from.leaf, it.leaves);
    reorder(origins_, origins_before_, to.node, from.node, it.nodes);
  }
}

void ChildOrder::move(KeptState& state, std::span<const NodeIndex> places) {
  symmetry_.number_kept_children(tree_, state.words, Symmetry::Numbered::FromNode);
  before_ = state;
  for (const EqualChildren& it : symmetry_.classes()) {
    for (const EqualChildren::Place& child : it.places) {
      for (NodeIndex i = 0; i < it.nodes; ++i) {
        const NodeIndex from = child.node + i, to = places[from];
        state.activity[to] = before_.activity[from];
        // Equal nodes keep as many bytes, and each begins at a word.
        const std::size_t size =
            tree_.nodes[from].kind->state_size +
            std::size_t{tree_.nodes[from].kind->state_per_child} * tree_.nodes[from].children;
        const auto words = static_cast<std::uint32_t>((size + 7) / 8);
        reorder(state.words, before_.words, tree_.nodes[to].state / 8, tree_.nodes[from].state / 8,
                words);
      }
    }
  }
  symmetry_.number_kept_children(tree_, state.words, Symmetry::Numbered::InTree);
  for (std::uint32_t leaf = 0; leaf < tree_.leaves.size(); ++leaf) {
    const NodeIndex to = places[tree_.leaves[leaf].node];
    state.leaves[tree_.nodes[to].params] = before_.leaves[leaf];
  }
}

}  // namespace lockstep::host
