#include "run/live_moments.h"

#include <utility>

#include "engine/blackboard.h"
#include "engine/pace.h"
#include "engine/resources.h"
#include "engine/ticker.h"

namespace lockstep::host {

LiveMoments::LiveMoments(const Tree& tree, const AskedOfRun& asked)
    : tree_(tree),
      progress_(asked.progress.empty() ? 0 : tree.nodes.size()),
      limits_(tree.nodes.size()),
      uses_(tree.nodes.size()),
      synchronized_(synchronized_nodes(tree)),
      stood_still_(asked.stood_still),
      asks_progress_(!asked.progress.empty()),
      asks_within_(asked.within),
      asks_progress_within_(asked.progress_within) {
  for (const NodeIndex node : asked.progress) asked_.push_back({.node = node});
  own_progress_.reserve(asked_.size());
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const Synchronization kind = synchronization(tree.nodes[node]);
    if (compares_progress(kind)) {
      const auto children = children_of(tree, node);
      for (Asked& it : asked_) {
        const auto child = std::ranges::find(children, it.node);
        if (child == children.end()) continue;
        it = {it.node, node, static_cast<std::size_t>(child - children.begin()), true};
      }
    } else if (kind != Synchronization::None || tree.labels[node].type->latches) {
      Plain& it = plain_.emplace_back(Plain{.node = node, .children = children_of(tree, node)});
      it.is_asked = std::ranges::find(asked.parallels, node) != asked.parallels.end();
      it.progress.resize(it.children.size());
      asks_progress_ |= it.is_asked;
    }
  }
  for (const Plain& it : plain_) uses_[it.node] = it.progress;
  moment_.progress = progress_;
  moment_.limits = limits_;
  moment_.uses = uses_;
  moment_.heard = asked.heard;
  const auto paces = [](const Node& it) { return it.kind->paced_child != nullptr; };
  if (std::ranges::any_of(tree.nodes, paces)) {
    factors_.resize(tree.nodes.size());
  }
  moment_.factors = factors_;
}

void LiveMoments::begin(Ticker& ticker) const {
  if (asks_progress_within_) return ticker.keep_moments_with_progress();
  if (asks_within_) ticker.keep_moments();
}

void LiveMoments::ask(Ticker& ticker) {
  begin(ticker);
  if (!asks_progress_) return;
  ticker.share_progress();
  for (const Asked& it : asked_) progress_[it.node] = ticker.progress(it.node);
  // A node that does not run will start again: none of its children has progress then. Else as in
  // the snapshot of a synchronized node: a child that was skipped is left out, and one that has
  // failed for good counts as 1.
  for (Plain& it : plain_) {
    if (!it.is_asked) continue;
    const bool runs = ticker.status(it.node) == Status::Running;
    for (std::size_t child = 0; child < it.progress.size(); ++child) {
      it.progress[child] = runs ? snapshot_of(ticker, it.children[child]) : 0;
    }
  }
}

// The states of nodes stay where they are for the whole life of a ticker.
void LiveMoments::bind(Ticker& ticker) {
  const RunState& state = ticker.run_state();
  bound_ = state.bytes.data();
  moment_.activity = state.activity;
  moment_.reached = state.last_tick;
  const auto point_to_limit = [&](NodeIndex node) {
    limits_[node] = &ticker.state<SynchronizedState>(node).limit;
  };
  for (const NodeIndex node : synchronized_) {
    point_to_limit(node);
    if (compares_progress(synchronization(tree_.nodes[node]))) {
      uses_[node] = child_progress(ticker, node);
    }
  }
  for_each_resource_user(tree_, point_to_limit);
  if (!factors_.empty()) point_to_factors(ticker);
}

void LiveMoments::point_to_factors(Ticker& ticker) {
  for (NodeIndex node = 0; node < tree_.nodes.size(); ++node) {
    const auto paced_child = tree_.nodes[node].kind->paced_child;
    if (paced_child == nullptr) continue;
    std::uint32_t place = 0;
    for_each_child(tree_, node, [&](NodeIndex child) {
      factors_[child] = &paced_child(ticker, node, place++)->given;
    });
  }
}

// The numbers that a synchronized node has used replace those from before its tick.
void LiveMoments::take_used(Ticker& ticker) {
  own_progress_.clear();
  for (const Asked& it : asked_) {
    if (!it.is_kept || !asked_children(ticker, it.keeper)) continue;
    const double used = uses_[it.keeper][it.child];
    const double own = std::exchange(progress_[it.node], is_left_out(used) ? 0 : used);
    if (own != progress_[it.node]) own_progress_.push_back({.node = it.node, .progress = own});
  }
}

const Moment& LiveMoments::now(Ticker& ticker) {
  const RunState& state = ticker.run_state();
  const bool is_bound =
      moment_.activity.data() == state.activity.data() && bound_ == state.bytes.data();
  if (!is_bound) [[unlikely]]
    bind(ticker);
  ticker_ = &ticker;
  moment_.live = this;
  moment_.number = state.tick_number;
  moment_.ended = state.ended;
  if (stood_still_ != nullptr) moment_.stood_still = *stood_still_;
  moment_.reasons = ticker.reasons();
  moment_.answers = ticker.answers();
  moment_.entries = ticker.blackboard().entries;
  return moment_;
}

const Moment& LiveMoments::after_tick(Ticker& ticker, std::uint64_t tick, Nanoseconds time) {
  now(ticker);
  if (!asked_.empty()) take_used(ticker);
  moment_.tick = tick;
  moment_.time = time;
  if (asks_within_) moment_.within = ticker.moments();
  if (asks_progress_within_ && moment_.within.empty()) moment_.within.progress = own_progress_;
  return moment_;
}

double LiveMoments::progress(NodeIndex node) {
  return ticker_->progress(node);
}
void LiveMoments::share_progress() {
  ticker_->share_progress();
}
Round LiveMoments::round(NodeIndex node) {
  return tree_.nodes[node].kind->round(*ticker_, node);
}
bool LiveMoments::is_held_at_barrier(NodeIndex member) {
  return host::is_held_at_barrier(*ticker_, member);
}
bool LiveMoments::faulted() const {
  return ticker_->faulted();
}
std::span<const Fault> LiveMoments::tolerated() const {
  return ticker_->tolerated();
}
std::span<const OutOfRange> LiveMoments::out_of_range() const {
  return ticker_->out_of_range();
}
std::span<const WentOn> LiveMoments::went_on() const {
  return ticker_->went_on();
}

}  // namespace lockstep::host
