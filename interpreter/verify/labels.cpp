#include "verify/labels.h"

#include <algorithm>
#include <cstring>

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
      properties_(properties),
      number_of_leaf_(tree.nodes.size(), kStays),
      number_of_held_(tree.nodes.size(), kStays),
      bits_(LabelShape{tree.leaves.size(), held_.size(), properties}.bytes()) {
  for (std::uint32_t i = 0; i < tree.leaves.size(); ++i) {
    const NodeIndex node = tree.leaves[i].node;
    if (!symmetry.moves(node)) continue;
    number_of_leaf_[node] = static_cast<std::uint32_t>(moving_leaves_.size());
    moving_leaves_.push_back(i);
  }
  for (std::uint32_t i = 0; i < held_.size(); ++i) {
    if (!symmetry.moves(held_[i].child)) continue;
    number_of_held_[held_[i].child] = static_cast<std::uint32_t>(moving_held_.size());
    moving_held_.push_back(i);
  }
  for (const std::uint32_t leaf : moving_leaves_) {
    const std::uint32_t held = number_of_held_[tree.leaves[leaf].node];
    held_of_leaf_.push_back(held == kStays ? LabelShape::kNowhere
                                           : static_cast<LabelShape::Place>(held));
  }
}

LabelShape Labeller::shape() const {
  return {tree_.leaves.size(), held_.size(), properties_,
          moving_leaves_,      moving_held_, held_of_leaf_};
}

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

const LabelTable::Bits& Labeller::with_moves(const Stepper& stepper) {
  const std::span<const NodeIndex> origins = stepper.origins();
  const TickAnswers& answers = stepper.answers();
  if (origins.empty() && !answers.has_equal()) return bits_;
  const std::size_t leaves = moving_leaves_.size(), moves = leaves + moving_held_.size();
  with_moves_.resize(bits_.size() +
                     (moves + (answers.has_equal() ? leaves : 0)) * sizeof(LabelShape::Place));
  std::ranges::copy(bits_, with_moves_.begin());
  const auto put = [&](std::size_t number, std::size_t value) {
    const auto place = static_cast<LabelShape::Place>(value);
    std::memcpy(with_moves_.data() + bits_.size() + number * sizeof place, &place, sizeof place);
  };
  const auto origin = [&](NodeIndex node) { return origins.empty() ? node : origins[node]; };
  for (std::size_t to = 0; to < leaves; ++to) {
    put(number_of_leaf_[origin(tree_.leaves[moving_leaves_[to]].node)], to);
  }
  for (std::size_t to = 0; to < moving_held_.size(); ++to) {
    put(leaves + number_of_held_[origin(held_[moving_held_[to]].child)], leaves + to);
  }
  for (std::size_t i = 0; i < leaves && answers.has_equal(); ++i) {
    const std::uint32_t before = answers.equal_before(moving_leaves_[i]);
    put(moves + i, before == TickAnswers::kNone ? i : number_of_leaf_[tree_.leaves[before].node]);
  }
  return with_moves_;
}

LabelTable::Bits Labeller::moved(const LabelTable::Bits& bits,
                                 std::span<const NodeIndex> places) const {
  const LabelShape shape = this->shape();
  LabelTable::Bits moved = bits;
  const auto move = [&](std::size_t from, std::size_t to) {
    if (LabelTable::has(bits, from)) LabelTable::set(moved, to);
  };
  const auto clear = [&](std::size_t bit) { moved[bit / 8] &= ~(std::byte{1} << bit % 8); };
  for (const std::uint32_t leaf : moving_leaves_) {
    clear(shape.worked_bit(leaf));
    clear(shape.ended_bit(leaf));
  }
  for (const std::uint32_t child : moving_held_) clear(shape.held_bit(child));
  for (const std::uint32_t leaf : moving_leaves_) {
    const std::size_t to = moving_leaves_[number_of_leaf_[places[tree_.leaves[leaf].node]]];
    move(shape.worked_bit(leaf), shape.worked_bit(to));
    move(shape.ended_bit(leaf), shape.ended_bit(to));
  }
  for (const std::uint32_t child : moving_held_) {
    const std::size_t to = moving_held_[number_of_held_[places[held_[child].child]]];
    move(shape.held_bit(child), shape.held_bit(to));
  }
  return moved;
}

// A node that waits for resources is held also before it has begun.
bool Labeller::is_held(const Ticker& ticker, const Holdable& it) const {
  if (!is_pool(tree_, it.holder)) return ticker.held(it.child);
  return ticker.ticked(it.child - 1) && waits(limit(ticker, it.child - 1));
}

}  // namespace lockstep::host
