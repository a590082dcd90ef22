#include "run/leaf_calls.h"

#include <algorithm>
#include <map>
#include <string>

#include "engine/node_kind.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kUsualCalls = 8;  // of a leaf in a tick

bool keeps_result(const Tree& tree, NodeIndex node) {
  const NodeIndex parent = tree.labels[node].parent;
  return node == parent + 1 && tree.labels[parent].type->keeps_first_child &&
         unreset_by(*tree.labels[node].type) == Unreset::KeepsResult;
}

}  // namespace

LeafCalls::LeafCalls(const Shape& shape, const Tree& tree)
    : shape_(shape), moment_(shape.nodes.size()) {
  std::map<std::string, const LeafNode*> by_path;
  for (const LeafNode& leaf : tree.leaves) {
    const bool is_leaf = tree.nodes[leaf.node].children == 0;  // no control node of a plugin
    if (is_leaf) by_path[tree.path(leaf.node)] = &leaf;
  }
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    const auto leaf = by_path.find(shape.nodes[node].path);
    if (leaf == by_path.end()) continue;
    leaves_.push_back({node, leaf->second});
    const bool keeps = keeps_result(tree, leaf->second->node);
    followed_.push_back({.keeper = keeps ? shape.nodes[node].parent : std::nullopt});
    followed_.back().calls.reserve(kUsualCalls);
  }
}

double LeafCalls::progress_at(const Moment& tick, NodeIndex leaf, std::size_t moment) const {
  const bool is_own =
      tick.within.empty() || (!shape_.nodes[leaf].keeper && tick.within.progress.empty());
  double progress = is_own && !tick.progress.empty() ? tick.progress[leaf] : 0;
  for (const LeafProgress& it : tick.within.progress) {
    if (it.node == leaf && it.moment <= moment) progress = it.progress;
  }
  return progress;
}

template <class StateOf>
void LeafCalls::reach(const StateOf& state_of, std::optional<std::size_t> next) {
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    Followed& it = followed_[i];
    const NodeState state = state_of(leaves_[i].node);
    const bool is_kept = it.keeper && it.keeper_before == Status::Running && is_complete(it.before);
    if (state.ticked() && !is_kept)
      it.calls.push_back({state.status(), it.before != Status::Running, next});
    it.before = state.status();
    if (it.keeper) it.keeper_before = state_of(*it.keeper).status();
  }
}

void LeafCalls::begin(const Moment& before) {
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    followed_[i].before = before.status(leaves_[i].node);
    if (followed_[i].keeper) followed_[i].keeper_before = before.status(*followed_[i].keeper);
  }
}

void LeafCalls::take(const Moment& tick) {
  constexpr std::uint64_t kMost = 10'000;  // a run ticks no more often in one period
  for (Followed& it : followed_) it.calls.clear();
  if (tick.within.empty()) return reach([&](NodeIndex node) { return tick.state(node); });
  std::size_t number = 0;
  tick.within.each(moment_,
                   [&](std::span<const NodeState> states, const TickMoment& moment, bool is_last) {
                     const std::uint64_t times = std::min(moment.times, kMost);
                     for (std::uint64_t i = 1; i <= times; ++i) {
                       const std::size_t next = i < times ? number : number + 1;
                       reach([&](NodeIndex node) { return states[node]; },
                             is_last && i == times ? std::nullopt : std::optional(next));
                     }
                     ++number;
                   });
  begin(tick);
}

}  // namespace lockstep::host
