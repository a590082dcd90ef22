#include "tree/advise/dry_run.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/core/pre_order.h"

namespace lockstep::host {
namespace {

using Kind = DryNode::Kind;

constexpr double kTolerance = 1e-9;
constexpr double kStep = 0.01;  // how far a leaf goes beyond a limit that it may reach
constexpr double kNoLimit = std::numeric_limits<double>::infinity();
// In a tree of a million nodes as many steps as this take about as long as reading it.
constexpr std::uint64_t kWorkPerNode = 50, kLeastWork = 1'000'000;

}  // namespace

DryRun::DryRun(const DryTree& tree)
    : tree_(tree),
      states_(tree.nodes.size()),
      progress_(tree.nodes.size()),
      counted_(tree.nodes.size()),
      places_(tree.nodes.size()),
      least_(tree.nodes.size()),
      least_kept_(tree.keepers.size()),
      waits_at_(tree.nodes.size(), DryNode::kNone),
      waiting_(tree.keepers.size()) {
  for (std::uint32_t keeper = 0; keeper < tree.keepers.size(); ++keeper) {
    for (const std::uint32_t node : tree.keepers[keeper].kept) counted_[node] = counted(node);
    rescan_kept(keeper);
  }
}

bool DryRun::stands_still() {
  const std::uint64_t most_work = kLeastWork + kWorkPerNode * tree_.nodes.size();
  begin(0);
  while (work_ < most_work) {
    if (!beginning_.empty()) {
      const std::uint32_t node = beginning_.back();
      beginning_.pop_back();
      begin(node);
      continue;
    }
    const bool overtakes = ready_.empty();
    auto& leaves = overtakes ? ahead_ : ready_;
    if (leaves.empty()) return states_[0] != State::Done;
    const std::uint32_t leaf = leaves.back();
    leaves.pop_back();
    if (!overtakes || waits_at_[leaf] != DryNode::kNone) advance(leaf, overtakes);
  }
  return false;
}

bool DryRun::gains(std::uint32_t node) const {
  if (states_[node] == State::LaterRounds) return true;
  return tree_.nodes[node].kind == Kind::Leaf && states_[node] == State::Running;
}

std::uint32_t DryRun::held(std::uint32_t node) const {
  for (;; node = tree_.nodes[node].parent) {
    const std::uint32_t keeper = tree_.nodes[node].keeper;
    if (keeper != DryNode::kNone && holds(keeper, progress_[node])) return node;
    if (node == 0) return DryNode::kNone;
  }
}

std::uint32_t DryRun::last_of(std::uint32_t keeper) const {
  return *std::ranges::min_element(tree_.keepers[keeper].kept, {},
                                   [&](std::uint32_t node) { return counted_[node]; });
}

double DryRun::limit(std::uint32_t keeper) const {
  const DryKeeper& it = tree_.keepers[keeper];
  const double least = least_kept_[keeper].value;
  if (it.barriers == nullptr) return least + it.delta;
  const auto next = std::ranges::upper_bound(*it.barriers, least + kTolerance);
  return next == it.barriers->end() ? kNoLimit : *next;
}

// --- life ----------------------------------------------------------------------------------------

// In the same tick the children begin too, whatever is held from the next tick on.
void DryRun::begin(std::uint32_t node) {
  ++work_;
  const DryNode& it = tree_.nodes[node];
  states_[node] = State::Running;
  tell_keeper(node);
  if (it.kind == Kind::Leaf) return it.at_once ? complete(node) : ready_.push_back(node);
  places_[node] = node + 1;
  if (it.kind != Kind::All) return beginning_.push_back(node + 1);
  places_[node] = 0;
  for (const std::uint32_t child : children_in(tree_.nodes, node)) {
    beginning_.push_back(child);
    ++places_[node];
  }
  least_[node] = {0, places_[node]};
}

void DryRun::complete(std::uint32_t node) {
  for (;; node = tree_.nodes[node].parent) {
    ++work_;
    states_[node] = State::Done;
    rise(node, 1);
    if (node == 0 || goes_on(tree_.nodes[node].parent, node)) return;
  }
}

// Whether a node still runs after that child has succeeded.
bool DryRun::goes_on(std::uint32_t parent, std::uint32_t child) {
  switch (tree_.nodes[parent].kind) {
    case Kind::Leaf:
    case Kind::Around:
      return false;
    case Kind::All:
      return --places_[parent] > 0;
    case Kind::Sequence:
      if (tree_.nodes[child].end == tree_.nodes[parent].end) return false;
      places_[parent] = tree_.nodes[child].end;
      beginning_.push_back(places_[parent]);
      return true;
    case Kind::Rounds:
      // The members in it have succeeded, so nobody waits for them any more.
      states_[parent] = State::LaterRounds;
      ready_.push_back(parent);
      return true;
  }
  return false;
}

void DryRun::rise(std::uint32_t node, double progress) {
  for (;;) {
    ++work_;
    const DryNode& it = tree_.nodes[node];
    const double before = std::exchange(progress_[node], progress);
    tell_keeper(node);
    if (node == 0) return;
    if (tree_.nodes[it.parent].kind == Kind::All) {
      if (update(least_[it.parent], before, progress)) rescan(it.parent);
      progress = least_[it.parent].value;
    } else {
      progress = (it.place + progress) / it.parts;
    }
    node = it.parent;
    if (progress == progress_[node]) return;
  }
}

// --- who waits -----------------------------------------------------------------------------------

void DryRun::tell_keeper(std::uint32_t node) {
  const std::uint32_t keeper = tree_.nodes[node].keeper;
  if (keeper == DryNode::kNone) return;
  const double before = std::exchange(counted_[node], counted(node));
  if (!update(least_kept_[keeper], before, counted_[node])) return;
  rescan_kept(keeper);
  for (const std::uint32_t leaf : std::exchange(waiting_[keeper], {})) {
    ++work_;
    if (waits_at_[leaf] != keeper) continue;
    waits_at_[leaf] = DryNode::kNone;
    ready_.push_back(leaf);
  }
}

void DryRun::wait(std::uint32_t leaf, std::uint32_t keeper) {
  waits_at_[leaf] = keeper;
  waiting_[keeper].push_back(leaf);
}

// Returns whether none of the least is left.
bool DryRun::update(Least& least, double before, double now) {
  if (now < least.value - kTolerance) {
    least = {now, 1};
  } else if (before <= least.value + kTolerance && now > least.value + kTolerance) {
    return --least.many == 0;
  } else if (before > least.value + kTolerance && now <= least.value + kTolerance) {
    ++least.many;
  }
  return false;
}

void DryRun::rescan(std::uint32_t all) {
  Least& least = least_[all] = {1, 0};
  for (const std::uint32_t child : children_in(tree_.nodes, all)) {
    ++work_;
    least.value = std::min(least.value, progress_[child]);
  }
  for (const std::uint32_t child : children_in(tree_.nodes, all)) {
    least.many += progress_[child] <= least.value + kTolerance;
  }
}

void DryRun::rescan_kept(std::uint32_t keeper) {
  Least& least = least_kept_[keeper] = {1, 0};
  const auto& kept = tree_.keepers[keeper].kept;
  work_ += kept.size();
  for (const std::uint32_t node : kept) least.value = std::min(least.value, counted_[node]);
  for (const std::uint32_t node : kept) least.many += counted_[node] <= least.value + kTolerance;
}

double DryRun::counted(std::uint32_t node) const {
  const bool is_idle = states_[node] == State::Idle;
  return is_idle && !tree_.keepers[tree_.nodes[node].keeper].waits_for_idle ? 1 : progress_[node];
}

bool DryRun::holds(std::uint32_t keeper, double progress) const {
  const DryKeeper& it = tree_.keepers[keeper];
  const bool may_be_at = it.barriers == nullptr || it.ticks_at_barrier;
  return progress > limit(keeper) + (may_be_at ? kTolerance : -kTolerance);
}

// The next progress at which that keeper may hold.
double DryRun::next_stop(std::uint32_t keeper, double progress) const {
  const DryKeeper& it = tree_.keepers[keeper];
  if (it.barriers == nullptr) return std::max(progress, limit(keeper)) + kStep;
  const double beyond = it.ticks_at_barrier ? kStep : 0;
  const auto next = std::ranges::upper_bound(*it.barriers, progress - beyond + kTolerance);
  return next == it.barriers->end() ? kNoLimit : *next + beyond;
}

// --- steps ---------------------------------------------------------------------------------------

void DryRun::Share::pass(const DryNode& node) {
  scale /= node.parts;
  offset = (offset + node.place) / node.parts;
}

// To the next progress at which anybody may hold it. One that is beyond such a progress, because
// others beside it are not, waits for these as long as they can move.
void DryRun::advance(std::uint32_t leaf, bool overtakes) {
  waits_at_[leaf] = DryNode::kNone;
  const double progress = progress_[leaf];
  const double last = tree_.nodes[leaf].kind == Kind::Leaf ? tree_.nodes[leaf].last : 1;
  double next = progress < last - kTolerance ? last : 1;
  Share share;
  for (std::uint32_t node = leaf;; node = tree_.nodes[node].parent) {
    ++work_;
    if (const auto keeper = tree_.nodes[node].keeper; keeper != DryNode::kNone) {
      const double reached = share.of(progress);
      if (holds(keeper, progress_[node])) return wait(leaf, keeper);
      if (!overtakes && holds(keeper, reached)) {
        ahead_.push_back(leaf);
        return wait(leaf, keeper);
      }
      if (progress < last) {
        next = std::min(next, (next_stop(keeper, reached) - share.offset) / share.scale);
      }
    }
    if (node == 0) break;
    share.pass(tree_.nodes[node]);
  }
  if (next >= 1 - kTolerance) return complete(leaf);
  rise(leaf, std::max(next, progress + kTolerance));
  ready_.push_back(leaf);
}

}  // namespace lockstep::host
