#include "verify/labels.h"

#include "engine/resources.h"
#include "engine/ticker.h"

namespace lockstep::host {
namespace {

constexpr std::uint32_t kStays = 0xffffffff;

}  // namespace

std::vector<Holdable> holdable(const Tree& tree) {
  std::vector<Holdable> found;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const bool holds = tree.is_group(node) || compares_progress(synchronization(tree.nodes[node]));
    if (!holds) continue;
    for_each_child(tree, node, [&](NodeIndex child) { found.push_back({node, child}); });
  }
  return found;
}

Labeller::Labeller(const Tree& tree, const LeafModels& models, std::size_t properties,
                   const Symmetry& symmetry)
    : tree_(tree),
      models_(models),
      held_(holdable(tree)),
      shape_{tree.leaves.size(), held_.size(), properties},
      number_of_leaf_(tree.nodes.size(), kStays),
      number_of_held_(tree.nodes.size(), kStays) {
  for (std::uint32_t i = 0; i < tree.leaves.size(); ++i) {
    const NodeIndex node = tree.leaves[i].node;
    if (!symmetry.moves(node)) continue;
    number_of_leaf_[node] = static_cast<std::uint32_t>(shape_.moving_leaves.size());
    shape_.moving_leaves.push_back(i);
  }
  for (std::uint32_t i = 0; i < held_.size(); ++i) {
    if (!symmetry.moves(held_[i].child)) continue;
    number_of_held_[held_[i].child] = static_cast<std::uint32_t>(shape_.moving_held.size());
    shape_.moving_held.push_back(i);
  }
  for (const std::uint32_t leaf : shape_.moving_leaves) {
    const auto moved = symmetry.moved_with(tree.leaves[leaf].node);
    const std::uint32_t held = moved ? number_of_held_[moved->child] : kStays;
    shape_.held_of_leaf.push_back(held == kStays ? LabelShape::kNowhere
                                                 : static_cast<MovingPlace>(held));
  }
  shape_.clear(label_);
}

const Label& Labeller::of(Stepper& stepper) {
  const Ticker& ticker = stepper.ticker();
  const auto marks = stepper.leaves().marks();
  shape_.clear(label_);
  for (const std::uint32_t leaf : stepper.leaves().touched()) {
    if (!models_.leaves[leaf].ends) continue;
    if (!stepper.ran(leaf)) {
      label_.set(shape_.begun_bit());
    } else if (marks[leaf].ended) {
      label_.set(shape_.ended_bit(leaf));
    } else if (marks[leaf].ticked) {
      label_.set(shape_.worked_bit(leaf));
    }
  }
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (is_held(ticker, held_[i])) label_.set(shape_.held_bit(i));
  }
  for (std::size_t i = 0; i < shape_.properties; ++i) {
    if (stepper.owes(i)) label_.set(shape_.owed_bit(i));
  }
  return label_;
}

const Label& Labeller::with_moves(const Stepper& stepper) {
  const std::span<const NodeIndex> origins = stepper.origins();
  if (origins.empty()) return label_;
  const std::size_t leaves = shape_.moving_leaves.size();
  for (std::size_t to = 0; to < leaves; ++to) {
    const NodeIndex node = tree_.leaves[shape_.moving_leaves[to]].node;
    label_.after[number_of_leaf_[origins[node]]] = static_cast<MovingPlace>(to);
  }
  for (std::size_t to = 0; to < shape_.moving_held.size(); ++to) {
    const NodeIndex node = held_[shape_.moving_held[to]].child;
    label_.after[leaves + number_of_held_[origins[node]]] = static_cast<MovingPlace>(leaves + to);
  }
  return label_;
}

Label Labeller::equals(const Stepper& stepper) const {
  Label label;
  shape_.clear(label);
  for (std::size_t i = 0; i < shape_.moving_leaves.size(); ++i) {
    const std::uint32_t before = stepper.answers().equal_before(shape_.moving_leaves[i]);
    if (before == TickAnswers::kNone) continue;
    label.after[i] = static_cast<MovingPlace>(number_of_leaf_[tree_.leaves[before].node]);
  }
  return label;
}

Label Labeller::moved(const Label& label, std::span<const NodeIndex> places) const {
  Label moved = label;
  const auto move = [&](std::size_t from, std::size_t to) {
    if (label.has(from)) moved.set(to);
  };
  for (const std::uint32_t leaf : shape_.moving_leaves) {
    moved.clear(shape_.worked_bit(leaf));
    moved.clear(shape_.ended_bit(leaf));
  }
  for (const std::uint32_t child : shape_.moving_held) moved.clear(shape_.held_bit(child));
  for (const std::uint32_t leaf : shape_.moving_leaves) {
    const std::size_t to = shape_.moving_leaves[number_of_leaf_[places[tree_.leaves[leaf].node]]];
    move(shape_.worked_bit(leaf), shape_.worked_bit(to));
    move(shape_.ended_bit(leaf), shape_.ended_bit(to));
  }
  for (const std::uint32_t child : shape_.moving_held) {
    const std::size_t to = shape_.moving_held[number_of_held_[places[held_[child].child]]];
    move(shape_.held_bit(child), shape_.held_bit(to));
  }
  return moved;
}

// A node that waits for resources is held also before it has begun.
bool Labeller::is_held(const Ticker& ticker, const Holdable& it) const {
  if (!is_pool(tree_, it.holder)) return ticker.held(it.child);
  return ticker.ticked(it.child - 1) && waits(limit(ticker, it.child - 1));
}

}  // namespace lockstep::host
