#include "judge/measure/live_ticks.h"

#include <algorithm>

#include "engine/blackboard.h"
#include "engine/synchronized.h"
#include "engine/ticker.h"

namespace lockstep::host {

namespace {

// A bool is 1 or 0.
double number_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  const auto* flag = std::get_if<bool>(&value);
  return flag != nullptr ? static_cast<double>(*flag) : kNoValue;
}

}  // namespace

LiveTicks::LiveTicks(const Tree& tree, const Measuring& measuring)
    : users_(measuring.users().begin(), measuring.users().end()),
      slots_(measuring.entries().begin(), measuring.entries().end()),
      numbers_(slots_.size()),
      parallel_ticks_(measuring.parallels().size()),
      node_ticks_(measuring.nodes().size()),
      user_ticks_(users_.size()),
      has_others_(!(measuring.nodes().empty() && users_.empty() && slots_.empty())),
      asks_(!measuring.nodes().empty()) {
  for (const NodeIndex node : measuring.parallels()) {
    parallels_.emplace_back(tree, node, measuring.needs_flags());
    asks_ |= !compares_progress(synchronization(tree.nodes[node]));
  }
  for (const NodeIndex node : measuring.nodes()) {
    Node measured{.index = node, .parent = {}, .child = 0};
    for (const NodeIndex keeper : synchronized_nodes(tree)) {
      if (!compares_progress(synchronization(tree.nodes[keeper]))) continue;
      const auto children = children_of(tree, keeper);
      const auto child = std::ranges::find(children, node);
      if (child == children.end()) continue;
      measured.parent = keeper;
      measured.child = static_cast<std::size_t>(child - children.begin());
    }
    nodes_.push_back(measured);
  }
  view_ = {.parallels = parallel_ticks_,
           .nodes = node_ticks_,
           .users = user_ticks_,
           .entries = numbers_};
}

void LiveTicks::before_tick(Ticker& ticker) {
  if (asks_) ticker.share_progress();
  for (SynchronizedProbe& parallel : parallels_) parallel.before_tick(ticker);
  if (!has_others_) return;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    node_ticks_[i].progress = ticker.progress(nodes_[i].index);
  }
}

const TickView& LiveTicks::read(Ticker& ticker, std::uint64_t tick, Nanoseconds time) {
  SynchronizedTick* next = parallel_ticks_.data();
  for (SynchronizedProbe& parallel : parallels_) parallel.read(ticker, time, *next++);
  if (has_others_) read_others(ticker);
  view_.tick = tick;
  view_.time = time;
  return view_;
}

void LiveTicks::read_others(Ticker& ticker) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    node_ticks_[i].ticked = ticker.ticked(node.index);
    node_ticks_[i].status = ticker.status(node.index);
    // The numbers that a synchronized node has used replace those from before its tick.
    if (node.parent && asked_children(ticker, *node.parent)) {
      const double used = child_progress(ticker, *node.parent)[node.child];
      node_ticks_[i].progress = is_left_out(used) ? 0 : used;  // as in recordings
    }
  }
  for (std::size_t i = 0; i < users_.size(); ++i) {
    user_ticks_[i] = {ticker.ticked(users_[i]), limit(ticker, users_[i])};
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    numbers_[i] = number_of(ticker.blackboard().entries[slots_[i]].value());
  }
}

}  // namespace lockstep::host
