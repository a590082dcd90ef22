#include "scenario/recorded_calls.h"

#include <algorithm>
#include <map>
#include <string>

#include "engine/node_kind.h"

namespace lockstep::host {
namespace {

bool keeps_result(const Tree& tree, NodeIndex node) {
  const NodeIndex parent = tree.labels[node].parent;
  return node == parent + 1 && tree.labels[parent].type->keeps_first_child &&
         unreset_by(*tree.labels[node].type) == Unreset::KeepsResult;
}

}  // namespace

RecordedCalls::RecordedCalls(const RecordingHeader& header, const Tree& tree) : header_(header) {
  std::map<std::string, const LeafNode*> by_path;
  for (const LeafNode& leaf : tree.leaves) by_path[tree.path(leaf.node)] = &leaf;
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    const auto leaf = by_path.find(header.nodes[node].path);
    if (leaf == by_path.end()) continue;
    leaves_.push_back({node, leaf->second});
    const bool keeps = keeps_result(tree, leaf->second->node);
    followed_.push_back({.keeper = keeps ? header.nodes[node].parent : std::nullopt});
  }
}

double RecordedCalls::progress_at(const RecordedTick& tick, NodeIndex leaf,
                                  std::size_t moment) const {
  const bool is_own =
      header_.nodes[leaf].keeper ? tick.moments.empty() : tick.moments.progress.empty();
  double progress = is_own ? tick.nodes[leaf].progress : 0;
  for (const LeafProgress& it : tick.moments.progress) {
    if (it.node == leaf && it.moment <= moment) progress = it.progress;
  }
  return progress;
}

template <class StateOf>
void RecordedCalls::reach(const StateOf& state_of, std::optional<std::size_t> next) {
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    Followed& it = followed_[i];
    const auto [status, ticked] = state_of(leaves_[i].node);
    const bool is_kept = it.keeper && it.keeper_before == Status::Running && is_complete(it.before);
    if (ticked && !is_kept) it.calls.push_back({status, it.before != Status::Running, next});
    it.before = status;
    if (it.keeper) it.keeper_before = state_of(*it.keeper).first;
  }
}

void RecordedCalls::take(const RecordedTick& tick) {
  constexpr std::uint64_t kMost = 10'000;  // a run ticks no more often in one period
  for (Followed& it : followed_) it.calls.clear();
  const auto after = [&](NodeIndex node) {
    return std::pair(tick.nodes[node].status, bool(tick.nodes[node].ticked));
  };
  if (tick.moments.empty()) return reach(after);
  std::size_t number = 0;
  tick.moments.each(moment_,
                    [&](std::span<const NodeState> states, const TickMoment& moment, bool is_last) {
                      const std::uint64_t times = std::min(moment.times, kMost);
                      for (std::uint64_t i = 1; i <= times; ++i) {
                        const std::size_t next = i < times ? number : number + 1;
                        reach(
                            [&](NodeIndex node) {
                              return std::pair(states[node].status(), bool(states[node].ticked()));
                            },
                            is_last && i == times ? std::nullopt : std::optional(next));
                      }
                      ++number;
                    });
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    followed_[i].before = after(leaves_[i].node).first;
    if (followed_[i].keeper) followed_[i].keeper_before = after(*followed_[i].keeper).first;
  }
}

}  // namespace lockstep::host
