#include "engine/moments.h"

#include <algorithm>
#include <cstring>

#include "engine/node_context.h"
#include "engine/synchronized.h"
#include "engine/tree.h"

namespace lockstep::host {
namespace {

// Of a node that the tick has reached in an earlier moment, until the tick has ended.
std::uint32_t earlier(const RunState& state) {
  return ~state.tick_number;
}

// Whether who holds has decided: a parallel that has asked its children, or a member of a group.
template <class IsTicked>
bool decides(const RunView& run, NodeIndex holder, IsTicked is_ticked) {
  if (!compares_progress(synchronization(run.node(holder)))) return is_ticked(holder);
  NodeIndex child = holder + 1;
  while (child != run.end_of(holder) && !is_ticked(child)) child = run.end_of(child);
  return child != run.end_of(holder);
}

// Who holds it, as the nodes around `under` are in their ticks, which keep their earlier states
// until then. Nothing: a node that holds none goes on, and has not come to it.
std::optional<OutermostHold> hold_in(const NodeContext& context, NodeIndex held,
                                     std::optional<NodeIndex> under) {
  const Tree& tree = context.tree();
  const auto is_in_tick = [&](NodeIndex node) {
    return under && node <= *under && *under < context.end_of(node);
  };
  NodeIndex holder = tree.labels[held].parent;
  while (context.held(holder) && holder != held && !is_in_tick(holder)) {
    held = holder;
    holder = tree.labels[held].parent;
  }
  const bool holds = compares_progress(synchronization(tree.nodes[holder])) ||
                     std::ranges::find(tree.members, holder, &Member::node) != tree.members.end();
  return holds ? std::optional(OutermostHold{holder, held}) : std::nullopt;
}

}  // namespace

Moments::Moments(NodeContext& context)
    : context_(context),
      tree_(context.tree()),
      first_(tree_.nodes.size()),
      last_(tree_.nodes.size()),
      now_(tree_.nodes.size()),
      counted_(tree_.nodes.size()),
      totals_(tree_.nodes.size()),
      rest_(tree_.nodes.size()) {
  moments_.reserve(kMost);
  changes_.reserve(most_changes(tree_.nodes.size()));
  open_holds_.reserve(tree_.nodes.size());
}

void Moments::keep_progress() {
  leaves_.resize(tree_.leaves.size());
  kept_leaves_.resize(tree_.leaves.size());
  progress_.reserve(most_progress(tree_.leaves.size()));
}

void Moments::begin_tick(const RunState& state) {
  static_assert(sizeof(NodeState) == sizeof(Activity));
  std::memcpy(static_cast<void*>(now_.data()), state.activity.data(), now_.size());
  moments_.clear();
  changes_.clear();
  progress_.clear();
  rests_ = 0;
  is_full_ = false;
  in_tick_ = true;
  halts_under.reset();
}

void Moments::next(RunState& state, std::optional<NodeIndex> under) {
  if (moments_.empty()) {
    ask_progress(true);
    open_holds_.clear();
    for (NodeIndex node = 0; node < now_.size(); ++node) {
      if (now_[node].held()) open_holds_.push_back(node);
    }
  }
  look(state, under);
  decide_holds(under);
  keep();
  mark(state);
  ask_progress(false);
}

void Moments::reopen(RunState& state) {
  in_tick_ = true;
  if (moments_.empty()) return next(state, std::nullopt);
  // Its last moment is kept already, with the changes that led to the state after the tick.
  changes_.resize(moments_.size() == 1 ? 0 : moments_[moments_.size() - 2].changes);
  rests_ = 0;
  mark(state);
  ask_progress(false);
}

void Moments::end_tick(RunState& state) {
  in_tick_ = false;
  if (moments_.empty()) return;
  look(state, std::nullopt);
  decide_holds(std::nullopt);
  keep();
  unmark(state);
  look(state, std::nullopt);
  add_changes(changes_.capacity());
  moments_.back().changes = static_cast<std::uint32_t>(changes_.size());
  if (!is_full_) return;
  for (NodeIndex node = 0; node < totals_.size(); ++node) {
    if (totals_[node].empty()) continue;
    rest_[rests_++] = {node, now_[node], totals_[node].counts};
  }
}

void Moments::mark(RunState& state) {
  const std::uint32_t tick = state.tick_number, before = earlier(state);
  for (std::uint32_t& it : state.last_tick) it = it == tick ? before : it;
}

void Moments::unmark(RunState& state) {
  const std::uint32_t tick = state.tick_number, before = earlier(state);
  for (std::uint32_t& it : state.last_tick) it = it == before ? tick : it;
}

void Moments::look(const RunState& state, std::optional<NodeIndex> under) {
  const std::uint32_t tick = state.tick_number;
  for (NodeIndex node = 0; node < now_.size(); ++node) {
    now_[node] = NodeState::of(state.activity[node], state.last_tick[node] == tick);
  }
  while (under) {
    now_[*under] = NodeState::of(Activity::Running, true);
    const NodeIndex parent = tree_.labels[*under].parent;
    under = parent == *under ? std::nullopt : std::optional(parent);
  }
}

bool Moments::is_withheld(NodeIndex held) const {
  const auto hold = hold_in(context_, held, halts_under);
  return hold &&
         decides(context_, hold->holder, [&](NodeIndex node) { return context_.ticked(node); });
}

// Whether the tick has come so far. A parallel decides about one child after the other.
bool Moments::is_decided(NodeIndex held, std::optional<NodeIndex> under) const {
  const auto hold = hold_in(context_, held, under);
  if (!hold) return false;
  const auto [holder, child] = *hold;
  if (under && holder < *under && *under < context_.end_of(holder)) return child < *under;
  return decides(context_, holder, [&](NodeIndex node) { return context_.ticked_so_far(node); });
}

// A hold that ends before its tick decides on it was none in this tick.
void Moments::decide_holds(std::optional<NodeIndex> under) {
  std::erase_if(open_holds_, [&](NodeIndex node) {
    if (now_[node].held()) return is_decided(node, under);
    for (NodeState* it : {&first_[node], &last_[node]}) *it = it->without_hold();
    return true;
  });
}

// The moment that has just ended.
void Moments::keep() {
  if (moments_.empty()) {
    first_ = last_ = now_;
    std::ranges::fill(kept_leaves_, 0.0);
    add_progress();
    moments_.push_back({});
    return;
  }
  if (is_full_) return count();
  if (now_ == last_ && leaves_ == kept_leaves_) {
    ++moments_.back().times;
    return;
  }
  const std::size_t before = changes_.size();
  if (moments_.size() < kMost && add_changes(kMostChanges + now_.size()) && add_progress()) {
    moments_.back().changes = static_cast<std::uint32_t>(changes_.size());
    moments_.push_back({});
    last_ = now_;
    return;
  }
  changes_.resize(before);
  is_full_ = true;
  counted_ = last_;
  std::ranges::fill(totals_, NodeTotals{});
  count();
}

void Moments::count() {
  for (NodeIndex node = 0; node < now_.size(); ++node) {
    totals_[node].add(counted_[node], now_[node]);
  }
  counted_ = now_;
}

// Those that run at the start of this moment. Before the tick, those who watch have asked them.
void Moments::ask_progress(bool is_first) {
  if (leaves_.empty() || is_full_) return;
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const NodeIndex node = tree_.leaves[i].node;
    if (is_first) {
      leaves_[i] = was_running(node) ? context_.progress_before_tick(node) : 0;
    } else {
      const bool runs = context_.status(node) == Status::Running && !context_.faulted();
      leaves_[i] = runs ? context_.progress(node) : 0;
    }
  }
}

// That of the moment that has just ended. False: it is too much.
bool Moments::add_progress() {
  const std::uint64_t moment = moments_.size();
  const std::size_t before = progress_.size();
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    if (leaves_[i] == kept_leaves_[i]) continue;
    if (progress_.size() == progress_.capacity()) {
      progress_.resize(before);
      return false;
    }
    progress_.push_back({moment, tree_.leaves[i].node, leaves_[i]});
  }
  kept_leaves_ = leaves_;
  return true;
}

// From the last moment that is kept to the state in `now_`. False: they are too many.
bool Moments::add_changes(std::size_t most) {
  for (NodeIndex node = 0; node < now_.size(); ++node) {
    if (now_[node] == last_[node]) continue;
    if (changes_.size() == most) return false;
    changes_.push_back({node, last_[node], now_[node]});
  }
  return true;
}

}  // namespace lockstep::host
