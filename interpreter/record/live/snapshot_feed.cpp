#include "record/live/snapshot_feed.h"

#include <algorithm>
#include <numeric>

#include "base/core/synchronization.h"

namespace lockstep::host {
namespace {

std::vector<std::uint32_t> all_slots(const Shape& shape) {
  std::vector<std::uint32_t> slots(shape.entries.size());
  std::iota(slots.begin(), slots.end(), 0u);
  return slots;
}

}  // namespace

SnapshotFeed::SnapshotFeed(const Shape& shape, RealTime real_time)
    : real_time_(real_time),
      users_(users_of_pools(shape)),
      repeating_(repeating_nodes(shape)),
      activity_(shape.nodes.size()),
      changes_(all_slots(shape)),
      entries_(shape.entries.size()),
      snapshots_(Snapshot{
          .header = {}, .nodes = std::vector<NodeView>(shape.nodes.size()), .entries = entries_}) {
  for (const NodeIndex node : synchronized_nodes(shape)) {
    if (!shape.nodes[node].is_pool()) compared_.emplace_back(shape, node, false);
  }
  const auto make_room = [](std::vector<EntryState>& entries) {
    for (EntryState& entry : entries) entry.text.reserve(EntryChanges::kNumber);
  };
  make_room(entries_);
  snapshots_.for_each([&](Snapshot& snapshot) { make_room(snapshot.entries); });
}

void SnapshotFeed::run_started(const Moment& moment, const RunStart& start) {
  header_.rate_hz = 1.0 / to_seconds(start.period);
  header_.real_time = start.real_time;
  if (start.first_tick > 0) header_.resumed_after = start.gap;
  publish(moment);
}

void SnapshotFeed::log(std::string_view who, std::string_view level, std::string_view text) {
  lines_.add(who, level, text);
}

void SnapshotFeed::after_tick(const Moment& moment, const TickReport& report) {
  header_.tick = report.tick;
  header_.time = report.time;
  *header_.overruns += report.skipped > 0;
  std::ranges::copy(moment.activity, activity_.begin());
  take_entries(moment, report.tick);
  take_logs();
  is_shown_ = false;
  const auto now = real_time_();
  if (now - published_ < kPeriod) return;
  published_ = now;
  publish(moment);
}

void SnapshotFeed::standing(const Moment& moment) {
  if (!is_shown_) publish(moment);
}

void SnapshotFeed::run_ended(const Moment& moment, const RunEnd& end) {
  header_.result = end.result();
  take_logs();  // of halts
  publish(moment);
}

void SnapshotFeed::publish(const Moment& moment) {
  Snapshot& back = snapshots_.back();
  back.header = header_;
  for (NodeIndex node = 0; node < back.nodes.size(); ++node) {
    back.nodes[node] = {.activity = activity_[node]};
  }
  take_progress(moment, back.nodes);
  for (const NodeIndex node : repeating_) {
    if (status_of(activity_[node]) != Status::Running) continue;
    back.nodes[node].round = moment.live->round(node);
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (back.entries[i].changed != entries_[i].changed) back.entries[i] = entries_[i];
  }
  const std::uint64_t left_out = lines_.left_out();
  if (back.logs.count() != logs_.count() + left_out) {
    back.logs = logs_;
    back.logs.earlier += left_out;
  }
  back.heard.assign(moment.heard.begin(), moment.heard.end());
  snapshots_.publish();
  is_shown_ = true;
}

void SnapshotFeed::take_entries(const Moment& moment, std::uint64_t tick) {
  for (const EntryChange& change : changes_.changes(moment.entries)) {
    entries_[change.entry].set(change.text, tick);
  }
  changes_.keep();
}

void SnapshotFeed::take_logs() {
  for (const LeafLine& line : lines_.lines()) logs_.add(line);
  lines_.keep();
}

void SnapshotFeed::take_progress(const Moment& moment, std::vector<NodeView>& views) const {
  for (const SynchronizedTicks& it : compared_) {
    views[it.node()].limit = moment.limit(it.node());
    const std::span<const double> used = moment.used(it.node());
    for (std::size_t number = 0; number < used.size(); ++number) {
      NodeView& child = views[it.children()[number]];
      child.progress = shown_progress(child.activity, is_left_out(used[number]) ? 0 : used[number]);
      child.factor = moment.factor(it.children()[number]);
    }
  }
  for (const NodeIndex node : users_) {
    views[node].limit = moment.limit(node);
    NodeView& child = views[node + 1];
    child.progress = shown_progress(child.activity, moment.live->progress(node + 1));
  }
}

}  // namespace lockstep::host
