#include "record/live/snapshot_feed.h"

#include <numeric>

#include "engine/resources.h"
#include "record/live/watched_nodes.h"

namespace lockstep::host {
namespace {

std::vector<std::uint32_t> all_slots(const Tree& tree) {
  std::vector<std::uint32_t> slots(tree.slots.size());
  std::iota(slots.begin(), slots.end(), 0u);
  return slots;
}

}  // namespace

SnapshotFeed::SnapshotFeed(const Tree& tree, RealTime real_time)
    : real_time_(real_time),
      synchronized_nodes_(synchronized_nodes(tree)),
      repeating_nodes_(repeating_nodes(tree)),
      activity_(tree.nodes.size()),
      changes_(all_slots(tree)),
      entries_(tree.slots.size()),
      snapshots_(Snapshot{
          .header = {}, .nodes = std::vector<NodeView>(tree.nodes.size()), .entries = entries_}) {
  const auto make_room = [](std::vector<EntryState>& entries) {
    for (EntryState& entry : entries) entry.text.reserve(EntryChanges::kNumber);
  };
  make_room(entries_);
  snapshots_.for_each([&](Snapshot& snapshot) { make_room(snapshot.entries); });
}

void SnapshotFeed::run_started(Ticker& ticker, const RunStart& start) {
  header_.rate_hz = 1.0 / to_seconds(start.period);
  header_.real_time = start.real_time;
  publish(ticker);
}

void SnapshotFeed::log(std::string_view who, std::string_view level, std::string_view text) {
  lines_.add(who, level, text);
}

void SnapshotFeed::after_tick(Ticker& ticker, const TickReport& report) {
  header_.tick = report.tick;
  header_.time = report.time;
  *header_.overruns += report.skipped > 0;
  activity_ = ticker.run_state().activity;
  take_entries(ticker, report.tick);
  take_logs();
  is_shown_ = false;
  const auto now = real_time_();
  if (now - published_ < kPeriod) return;
  published_ = now;
  publish(ticker);
}

void SnapshotFeed::standing(Ticker& ticker) {
  if (!is_shown_) publish(ticker);
}

void SnapshotFeed::run_ended(Ticker& ticker, const RunEnd& end) {
  header_.result = end.result();
  take_logs();  // of halts
  publish(ticker);
}

void SnapshotFeed::publish(Ticker& ticker) {
  Snapshot& back = snapshots_.back();
  back.header = header_;
  for (NodeIndex node = 0; node < back.nodes.size(); ++node) {
    back.nodes[node] = {.activity = activity_[node]};
  }
  for (const NodeIndex node : synchronized_nodes_) {
    if (compares_progress(synchronization(ticker.node(node))))
      take_progress(ticker, node, back.nodes);
  }
  for_each_resource_user(ticker.tree(), [&](NodeIndex node) {
    back.nodes[node].limit = limit(ticker, node);
    const double progress = ticker.progress(node + 1);
    back.nodes[node + 1].progress = shown_progress(activity_[node + 1], progress);
  });
  for (const NodeIndex node : repeating_nodes_) take_round(ticker, node, back.nodes[node]);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (back.entries[i].changed != entries_[i].changed) back.entries[i] = entries_[i];
  }
  const std::uint64_t left_out = lines_.left_out();
  if (back.logs.count() != logs_.count() + left_out) {
    back.logs = logs_;
    back.logs.earlier += left_out;
  }
  snapshots_.publish();
  is_shown_ = true;
}

void SnapshotFeed::take_entries(Ticker& ticker, std::uint64_t tick) {
  for (const EntryChange& change : changes_.changes(ticker.blackboard())) {
    entries_[change.entry].set(change.text, tick);
  }
  changes_.keep();
}

void SnapshotFeed::take_logs() {
  for (const LeafLine& line : lines_.lines()) logs_.add(line);
  lines_.keep();
}

void SnapshotFeed::take_round(Ticker& ticker, NodeIndex node, NodeView& view) {
  if (view.activity != Activity::Running && view.activity != Activity::Paused) return;
  view.round = ticker.tree().nodes[node].kind->round(ticker, node);
}

void SnapshotFeed::take_progress(Ticker& ticker, NodeIndex node,
                                 std::vector<NodeView>& views) const {
  views[node].limit = limit(ticker, node);
  each_used_progress(ticker, node, [&](NodeIndex child, double used) {
    views[child].progress = shown_progress(views[child].activity, used);
  });
}

}  // namespace lockstep::host
