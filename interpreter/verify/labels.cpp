#include "verify/labels.h"

#include <algorithm>

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
    if (symmetry.moves(held_[i].child)) shape_.moving_held.push_back(i);
  }
  std::ranges::sort(shape_.moving_held, {}, [&](std::uint32_t i) { return held_[i].child; });
  for (std::uint32_t i = 0; i < shape_.moving_held.size(); ++i) {
    number_of_held_[held_[shape_.moving_held[i]].child] = i;
  }
  for (auto it = symmetry.classes().rbegin(); it != symmetry.classes().rend(); ++it) {
    shape_.moving_children.push_back(moving_children(*it));
  }
  shape_.clear(label_);
}

MovingChildren Labeller::moving_children(const EqualChildren& all) const {
  const auto leaf_at = [&](NodeIndex node) {
    const auto node_of = [&](std::uint32_t leaf) { return tree_.leaves[leaf].node; };
    const auto it = std::ranges::lower_bound(shape_.moving_leaves, node, {}, node_of);
    return static_cast<std::size_t>(it - shape_.moving_leaves.begin());
  };
  const auto held_at = [&](NodeIndex node) {
    const auto child_of = [&](std::uint32_t held) { return held_[held].child; };
    const auto it = std::ranges::lower_bound(shape_.moving_held, node, {}, child_of);
    return static_cast<std::size_t>(it - shape_.moving_held.begin());
  };
  const NodeIndex first = all.places.front().node, end = first + all.nodes;
  MovingChildren found{leaf_at(end) - leaf_at(first), held_at(end) - held_at(first), {}};
  for (const auto& it : all.places) found.places.push_back({leaf_at(it.node), held_at(it.node)});
  return found;
}

const Label& Labeller::of(Stepper& stepper) {
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
  add_held(stepper, label_);
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
  move_held(origins, false);
  return label_;
}

const Label& Labeller::only_held(const Stepper& stepper) {
  shape_.clear_all_but_held(label_);
  if (const auto origins = stepper.origins(); !origins.empty()) move_held(origins, true);
  return label_;
}

void Labeller::move_held(std::span<const NodeIndex> origins, bool only_held) {
  const std::size_t leaves = shape_.moving_leaves.size();
  for (std::size_t to = 0; to < shape_.moving_held.size(); ++to) {
    const std::uint32_t from = number_of_held_[origins[held_[shape_.moving_held[to]].child]];
    if (only_held && !label_.has(shape_.held_bit(shape_.moving_held[from]))) continue;
    label_.after[leaves + from] = static_cast<MovingPlace>(leaves + to);
  }
}

Label Labeller::equals(const Stepper& stepper) const {
  Label label;
  std::vector<LabelShape::EqualChild> equal;
  for (const TickAnswers::EqualChild& it : stepper.answers().equal_children()) {
    equal.push_back({shape_.moving_children.size() - 1 - it.of, it.place});
  }
  shape_.set_equals(equal, label);
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

void Labeller::add_held(const Stepper& stepper, Label& label) const {
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const std::size_t bit = shape_.held_bit(i);
    if (!label.has(bit) && is_held(stepper, held_[i])) label.set(bit);
  }
}

// A node that waits for resources is held also before it has begun. What is held in the tick in
// which its holder ends is halted then, as SynchronizedTicks has it.
bool Labeller::is_held(const Stepper& stepper, const Holdable& it) const {
  const Ticker& ticker = stepper.ticker();
  if (is_pool(tree_, it.holder)) {
    return ticker.ticked(it.child - 1) && waits(limit(ticker, it.child - 1));
  }
  if (ticker.held(it.child)) return true;
  if (tree_.is_group(it.holder) &&
      waits_to_begin(ticker.status(it.child - 1), ticker.status(it.child))) {
    return true;
  }
  const bool is_halted = ticker.status(it.child) == Status::Idle && !ticker.ticked(it.child) &&
                         status_of(stepper.before().run.activity[it.child]) == Status::Running;
  if (!is_halted) return false;
  if (tree_.is_group(it.holder)) return ticker.ticked(it.child - 1);
  for (NodeIndex child = it.holder + 1; child < tree_.nodes[it.holder].end;
       child = tree_.nodes[child].end) {
    if (ticker.ticked(child)) return true;
  }
  return false;
}

}  // namespace lockstep::host
