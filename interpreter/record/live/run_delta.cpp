#include "record/live/run_delta.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "base/core/differences.h"
#include "engine/resources.h"
#include "engine/ticker.h"
#include "record/live/watched_nodes.h"

namespace lockstep::host {
namespace {

constexpr std::uint8_t kMoved = 32;     // above NodeChange::kTicked
constexpr std::uint8_t kUnknown = 255;  // no Activity

bool is_running(std::uint8_t state) {
  return status_of(static_cast<Activity>(state & (NodeChange::kTicked - 1u))) == Status::Running;
}

// Simple enough for the compiler to do many nodes at a time.
void put_states(const RunState& run, std::uint32_t tick, const std::uint8_t* moved,
                std::uint8_t* states) {
  const std::uint8_t ticked = tick != 0 ? NodeChange::kTicked : 0;  // 0: there was none yet
  const Activity* const activity = run.activity.data();
  const std::uint32_t* const last = run.last_tick.data();
  const std::size_t count = run.activity.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto of_tick = static_cast<std::uint8_t>(last[i] == tick ? ticked : 0);
    states[i] =
        static_cast<std::uint8_t>(static_cast<std::uint8_t>(activity[i]) | of_tick | moved[i]);
  }
}

// The synchronized nodes, and the children that measures compare, in order.
std::vector<NodeIndex> measured_nodes(const Tree& tree) {
  std::set<NodeIndex> nodes;
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const bool synchronizes = compares_progress(synchronization(tree.nodes[node]));
    if (synchronizes) nodes.insert(node);
    if (!synchronizes && !tree.labels[node].type->latches) continue;
    for_each_child(tree, node, [&](NodeIndex child) { nodes.insert(child); });
  }
  return {nodes.begin(), nodes.end()};
}

}  // namespace

RunDelta::RunDelta(const Tree& tree)
    : synchronized_nodes_(synchronized_nodes(tree)),
      measured_(measured_nodes(tree)),
      succeeded_(measured_),  // for its room
      limits_(synchronized_nodes_.size()),
      progress_(tree.nodes.size()),
      source_(tree.nodes.size()),
      moved_(tree.nodes.size()),
      state_(tree.nodes.size()),
      kept_(tree.nodes.size()),
      kept_progress_(tree.nodes.size()),
      changes_(tree.nodes.size()) {
  for (const NodeIndex node : synchronized_nodes_) kept_limits_.push_back({.node = node});
  for_each_resource_user(tree, [this](NodeIndex node) { kept_limits_.push_back({.node = node}); });
  first_user_ = synchronized_nodes_.size();
  limits_.reserve(kept_limits_.size());
  for (const NodeIndex node : repeating_nodes(tree)) kept_rounds_.push_back({.node = node});
  rounds_.reserve(kept_rounds_.size());
}

// Only running nodes are asked. The progress of all others follows from their Activity, so it is
// computed again only after a change of Activity.
void RunDelta::before_tick(Ticker& ticker) {
  ticker.share_progress();
  const std::span<const Activity> activity = ticker.run_state().activity;
  for_each_difference(activity, source_.data(), [&](NodeIndex node) {
    set_progress(node, ticker.progress(node));
    const bool running = status_of(activity[node]) == Status::Running;
    source_[node] = running ? kUnknown : static_cast<std::uint8_t>(activity[node]);
  });
}

std::span<const NodeChange> RunDelta::changes(Ticker& ticker) {
  take_snapshots(ticker);
  put_states(ticker.run_state(), ticker.tick_number(), moved_.data(), state_.data());
  count_ = 0;
  has_turns_ = has_begun_ = false;
  if (is_whole_) {
    for (NodeIndex node = 0; node < state_.size(); ++node) {
      if ((state_[node] | kept_[node]) != 0 || progress_[node] != 0) add_change(node);
    }
  } else {
    for_each_difference(std::span<const std::uint8_t>(state_), kept_.data(),
                        [this](NodeIndex node) { add_change(node); });
  }
  return {changes_.data(), count_};
}

void RunDelta::add_change(NodeIndex node) {
  const auto state = static_cast<std::uint8_t>(state_[node] & ~kMoved);
  changes_[count_++] = {.progress = progress_[node], .node = node, .state = state};
  has_turns_ |= state != kept_[node];
  has_begun_ |= is_running(state) && !is_running(kept_[node]);
}

std::span<const NodeIndex> RunDelta::succeeded(const Ticker& ticker) {
  succeeded_.clear();
  if (ticker.run_state().ended.empty()) return {};
  for (const NodeIndex node : measured_) {
    if (ticker.ended_after_success(node)) succeeded_.push_back(node);
  }
  return succeeded_;
}

std::span<const LimitChange> RunDelta::limits(Ticker& ticker) {
  limits_.clear();
  for (std::size_t i = 0; i < kept_limits_.size(); ++i) {
    const LimitChange& kept = kept_limits_[i];
    const bool is_as_kept = i < first_user_ && !ticker.ticked(kept.node);
    const double limit = is_as_kept ? kept.limit : lockstep::host::limit(ticker, kept.node);
    const bool is_new = limit != (all_limits_ ? 0 : kept.limit);
    if (is_new || (is_whole_ && limit != 0)) limits_.push_back({kept.node, limit});
  }
  return limits_;
}

std::span<const RoundChange> RunDelta::rounds(Ticker& ticker) {
  rounds_.clear();
  for (const RoundChange& kept : kept_rounds_) {
    const bool is_running = ticker.status(kept.node) == Status::Running;
    const Round round =
        is_running ? ticker.node(kept.node).kind->round(ticker, kept.node) : Round{};
    const bool is_new = round != kept.round;
    if (is_new || (is_whole_ && round != Round{})) rounds_.push_back({kept.node, round});
  }
  return rounds_;
}

void RunDelta::start_over() {
  std::ranges::fill(kept_, 0);
  std::ranges::fill(kept_progress_, 0);
  for (NodeIndex node = 0; node < progress_.size(); ++node) set_progress(node, progress_[node]);
  for (RoundChange& kept : kept_rounds_) kept.round = {};
  all_limits_ = true;
}

void RunDelta::keep() {
  all_limits_ = is_whole_ = false;
  auto kept_round = kept_rounds_.begin();
  for (const RoundChange& change : rounds_) {  // in the same order
    while (kept_round->node != change.node) ++kept_round;
    kept_round->round = change.round;
  }
  auto kept = kept_limits_.begin();
  for (const LimitChange& change : limits_) {  // in the same order
    while (kept->node != change.node) ++kept;
    kept->limit = change.limit;
  }
  for (const NodeChange& change : std::span(changes_).first(count_)) {
    kept_[change.node] = change.state;
    kept_progress_[change.node] = change.progress;
    moved_[change.node] = 0;
  }
}

void RunDelta::set_progress(NodeIndex node, double progress) {
  progress_[node] = progress;
  moved_[node] = progress != kept_progress_[node] ? kMoved : 0;
}

// The numbers that a synchronized node has used replace those from before its tick.
void RunDelta::take_snapshots(Ticker& ticker) {
  for (const NodeIndex node : synchronized_nodes_) {
    if (!compares_progress(synchronization(ticker.node(node)))) continue;
    if (!asked_children(ticker, node)) continue;
    each_used_progress(ticker, node, [&](NodeIndex child, double used) {
      set_progress(child, used);
      source_[child] = kUnknown;
    });
  }
}

}  // namespace lockstep::host
