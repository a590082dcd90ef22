#include "record/read/recorded_moments.h"

#include <algorithm>

#include "judge/summary/standstills.h"

namespace lockstep::host {
namespace {

// Until law 2, a recording names no children.
constexpr std::uint64_t kNamesChildren = 3;

// The nodes around each member of a group, below the node that has all members. Nodes are in
// pre-order, so of two nodes the later one is never above the other.
std::vector<std::vector<NodeIndex>> nodes_around(const Shape& shape,
                                                 const std::vector<NodeIndex>& members) {
  const auto parent = [&](NodeIndex node) { return shape.nodes[node].parent.value_or(0); };
  std::vector<std::vector<NodeIndex>> all;
  NodeIndex ancestor = members.empty() ? 0 : members.front();
  for (NodeIndex other : members) {
    while (other != ancestor)
      (other > ancestor ? other : ancestor) = parent(std::max(other, ancestor));
  }
  for (const NodeIndex member : members) {
    auto& around = all.emplace_back();
    for (NodeIndex node = parent(member); node > ancestor; node = parent(node)) {
      around.push_back(node);
    }
  }
  return all;
}

}  // namespace

RecordedMoments::RecordedMoments(const RecordingHeader& header)
    : header_(header),
      activity_(header.nodes.size()),
      reached_(header.nodes.size()),
      progress_(header.nodes.size()),
      limit_(header.nodes.size()),
      uses_(header.nodes.size()),
      is_guard_(header.nodes.size()),
      is_leaf_(header.nodes.size()),
      texts_(header.entries.size()),
      names_children_(header.law >= kNamesChildren) {
  const auto keeps = [](const ShapeNode& it) {
    return it.latches || it.synchronization != Synchronization::None;
  };
  // A recording is as large as it is: no room that doubles.
  limits_.reserve(header.nodes.size());
  keepers_.reserve(static_cast<std::size_t>(std::ranges::count_if(header.nodes, keeps)));
  for (NodeIndex node = 0; node < header.nodes.size(); ++node) {
    limits_.push_back(&limit_[node]);
    is_guard_[node] = header.nodes[node].is_guard;
    if (const auto parent = header.nodes[node].parent) {  // no barrier, no pool
      is_leaf_[node] = true;
      is_leaf_[*parent] = false;
    }
    if (keeps(header.nodes[node])) add(header, node);
  }
  for (const Keeper& it : keepers_) uses_[it.node] = it.used;
  if (std::ranges::any_of(header.nodes, &ShapeNode::paces)) {
    factor_.assign(header.nodes.size(), 1);
    for (const double& it : factor_) factors_.push_back(&it);
  }
  moment_ = {.activity = activity_,
             .reached = reached_,
             .number = 1,
             .progress = progress_,
             .limits = limits_,
             .uses = uses_,
             .factors = factors_,
             .texts = texts_};
}

void RecordedMoments::add(const RecordingHeader& header, NodeIndex node) {
  const ShapeNode& it = header.nodes[node];
  Keeper& keeper =
      keepers_.emplace_back(Keeper{.node = node,
                                   .is_plain = it.synchronization == Synchronization::None,
                                   .ignores_idle = it.ignores_idle,
                                   .holds_first = it.holds_first,
                                   .children = it.held()});
  for (const NodeIndex child : it.members) {
    keeper.members.push_back(header.nodes[child].parent.value_or(0));
  }
  keeper.around = nodes_around(header, keeper.members);
  keeper.used.resize(keeper.children.size());
}

const Moment& RecordedMoments::read(const RecordedTick& tick) {
  for (Keeper& keeper : keepers_) read_used(keeper, tick);
  for (const NodeIndex node : tick.changed) {
    const RecordedState& state = tick.nodes[node];
    activity_[node] = state.state().activity();
    reached_[node] = state.ticked ? 1 : 0;
    progress_[node] = state.progress;
    limit_[node] = state.limit;
    if (!factor_.empty()) factor_[node] = state.factor;
  }
  for (const RecordedEntry& entry : tick.entries) {
    texts_[entry.entry].text = entry.value;
    ++texts_[entry.entry].writes;
  }
  for (const RecordedReason& reason : tick.reasons) {
    auto it = std::ranges::find(reasons_, reason.node, &Reason::node);
    if (it == reasons_.end()) it = reasons_.insert(it, {.node = reason.node});
    it->text = reason.text;
  }
  take_heard(tick.heard, from_seconds(tick.time), heard_);
  moment_.heard = heard_;
  moment_.reasons = reasons_;
  moment_.answers = tick.answers;
  read_ended(tick);
  read_stood_still(tick);
  moment_.tick = tick.tick;
  moment_.time = from_seconds(tick.time);
  moment_.ended = ended_;
  moment_.stood_still = stood_still_;
  moment_.within =
      tick.moments.empty() ? MomentsView{.progress = tick.moments.progress} : tick.moments;
  return moment_;
}

// Of a recording that does not name the children that have succeeded, all are taken to have.
void RecordedMoments::read_ended(const RecordedTick& tick) {
  ended_.assign(tick.succeeded.begin(), tick.succeeded.end());
  if (names_children_ || ended_.empty()) return;
  for (const Keeper& keeper : keepers_) {
    if (std::ranges::find(tick.succeeded, keeper.node) == tick.succeeded.end()) continue;
    ended_.insert(ended_.end(), keeper.children.begin(), keeper.children.end());
  }
}

// Only a line that the run has logged tells it.
void RecordedMoments::read_stood_still(const RecordedTick& tick) {
  stood_still_.clear();
  for (const LeafLine& it : tick.logs) {
    if (!tells_of_end(it.who, it.text)) continue;
    const auto node = std::ranges::find(header_.nodes, it.who, &ShapeNode::path);
    if (node == header_.nodes.end()) continue;
    stood_still_.push_back(static_cast<NodeIndex>(node - header_.nodes.begin()));
  }
}

// Whether the whole tree was ticked again from one moment to the next, since a node had asked for
// it. Otherwise a node that is in its tick ticks a child again that had completed, or resets
// something; no leaf gets a tick while it is running that it has had.
bool RecordedMoments::is_ticked_again(std::span<const NodeState> was,
                                      std::span<const NodeState> now) const {
  if (was[0].status() != Status::Running || !now[0].ticked()) return false;
  bool is_within = false;
  for (NodeIndex node = 0; node < now.size(); ++node) {
    const bool was_running = was[node].ticked() && was[node].status() == Status::Running;
    if (is_leaf_[node] && was_running && now[node].ticked()) return true;
    const bool is_reset = was[node].status() != Status::Idle && now[node].status() == Status::Idle;
    const bool had_result = was[node].ticked() && has_ended(was[node].status());
    is_within |= is_reset || (had_result && now[node].ticked());
  }
  return !is_within;
}

// The moment after which a node asked its children for the last time in a tick; none: it asked them
// before the first one. It has asked again if the whole tree was ticked again, if it did not run,
// or if a child is ticked that had a result in this tick: a child whose tick has several moments,
// since something below it was reset, is Running between them.
std::optional<std::size_t> RecordedMoments::asked_after(const Keeper& keeper,
                                                        const MomentsView& moments) {
  std::optional<std::size_t> last;
  std::vector<bool> has_result(keeper.children.size());
  bool has_asked = false, begins = false;
  std::size_t number = 0;
  const auto look = [&](std::span<const NodeState> now, std::optional<std::size_t> before) {
    if (before) begins |= is_ticked_again(before_, now);
    if (now[keeper.node].ticked()) {
      for (std::size_t child = 0; child < has_result.size(); ++child)
        begins |= has_result[child] && now[keeper.children[child]].ticked();
      if (begins || !has_asked) {
        last = before;
        has_result.assign(has_result.size(), false);
      }
      has_asked = true;
      begins = false;
      for (std::size_t child = 0; child < has_result.size(); ++child) {
        const NodeState state = now[keeper.children[child]];
        has_result[child] = has_result[child] || (state.ticked() && has_ended(state.status()));
      }
    }
    begins |= now[keeper.node].status() != Status::Running;
    before_.assign(now.begin(), now.end());
  };
  moments.each(within_, [&](std::span<const NodeState> now, const TickMoment& it, bool) {
    look(now, number == 0 ? std::nullopt : std::optional(number - 1));
    if (it.times > 1) look(now, number);
    ++number;
  });
  return last;
}

// The columns are still those of the tick before.
void RecordedMoments::read_used(Keeper& keeper, const RecordedTick& tick) {
  const bool is_group = !keeper.members.empty();  // it asks them before the tree is ticked
  const bool asks_once = keeper.is_plain || is_group || tick.moments.empty();
  const auto last = asks_once ? std::nullopt : asked_after(keeper, tick.moments);
  within_.clear();
  if (last) tick.moments.after(*last, within_);
  for (std::size_t child = 0; child < keeper.children.size(); ++child) {
    const NodeIndex node = keeper.children[child];
    const RecordedState& state = tick.nodes[node];
    double& used = keeper.used[child];
    used = keeper.is_plain ? in_plain_parallel(keeper, child, tick) : state.progress;
    if (is_left_out(keeper, child)) used = kLeftOut;
  }
}

// What a node was when its parent asked.
Status RecordedMoments::before(NodeIndex node) const {
  return within_.empty() ? moment_.status(node) : within_[node].status();
}

// A parallel that does not synchronize is judged by what was there before its tick, and none of its
// children has progress when it starts again. A child that it does not tick again counts as 1.
double RecordedMoments::in_plain_parallel(const Keeper& keeper, std::size_t child,
                                          const RecordedTick& tick) {
  if (before(keeper.node) != Status::Running) return 0;
  const NodeIndex node = keeper.children[child];
  const bool has_failed = before(node) == Status::Failure;
  const bool is_latched = has_failed && !is_guard_[node] && !is_ticked(tick, keeper.node, node);
  return is_latched ? 1 : tick.nodes[node].progress;
}

// Whether a tick reaches a child before its parallel ends in it: after that, it may begin again.
bool RecordedMoments::is_ticked(const RecordedTick& tick, NodeIndex parallel, NodeIndex child) {
  if (tick.moments.empty()) return tick.nodes[child].ticked;
  bool is_ticked = false, has_ended = false;
  tick.moments.each(within_, [&](std::span<const NodeState> now, const TickMoment&, bool) {
    is_ticked |= !has_ended && now[child].ticked();
    has_ended |= now[parallel].status() != Status::Running;
  });
  within_.clear();
  return is_ticked;
}

// True for a child that was skipped in the last tick, or is in what was; in some groups also for a
// member that did not run, and had not succeeded, when the tick began.
bool RecordedMoments::is_left_out(const Keeper& keeper, std::size_t child) const {
  if (keeper.holds_first && child > 0) return false;
  const bool is_group = !keeper.members.empty();
  const bool runs = before(keeper.node) == Status::Running;
  const Status last = before(is_group ? keeper.members[child] : keeper.children[child]);
  const bool is_compared = is_group || !keeper.is_plain;
  if (is_compared && keeper.used[child] != 0) return false;  // what is left out has 0 in its line
  if (runs && last == Status::Skipped) return true;
  if (!is_group) return false;
  const auto was_skipped = [&](NodeIndex node) { return before(node) == Status::Skipped; };
  if (runs && std::ranges::any_of(keeper.around[child], was_skipped)) return true;
  return keeper.ignores_idle && (!runs || last == Status::Idle);
}

}  // namespace lockstep::host
