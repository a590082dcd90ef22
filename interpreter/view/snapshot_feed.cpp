#include "view/snapshot_feed.h"

#include "engine/synchronized.h"
#include "measure/synchronized_measure.h"

namespace lockstep {

SnapshotFeed::SnapshotFeed(const Tree& tree)
    : synchronized_nodes_(synchronized_nodes(tree)),
      activity_(tree.nodes.size()),
      snapshots_(Snapshot{.header = {}, .nodes = std::vector<NodeView>(tree.nodes.size())}) {
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    if (tree.nodes[node].kind->round != nullptr) repeating_nodes_.push_back(node);
  }
}

void SnapshotFeed::run_started(Ticker& ticker, const RunStart& start) {
  header_.rate_hz = 1.0 / to_seconds(start.period);
  header_.real_time = start.real_time;
  publish(ticker);
}

void SnapshotFeed::after_tick(Ticker& ticker, const TickReport& report) {
  header_.tick = report.tick;
  header_.time = report.time;
  *header_.overruns += report.skipped > 0;
  activity_ = ticker.run_state().activity;
  const auto now = monotonic_now();
  if (now - published_ < kPeriod) return;
  published_ = now;
  publish(ticker);
}

void SnapshotFeed::run_ended(Ticker& ticker, const RunEnd& end) {
  header_.result = end.result();
  publish(ticker);
}

void SnapshotFeed::publish(Ticker& ticker) {
  Snapshot& back = snapshots_.back();
  back.header = header_;
  for (NodeIndex node = 0; node < back.nodes.size(); ++node) {
    back.nodes[node] = {.activity = activity_[node]};
  }
  for (const NodeIndex node : synchronized_nodes_) take_progress(ticker, node, back.nodes);
  for (const NodeIndex node : repeating_nodes_) take_round(ticker, node, back.nodes[node]);
  snapshots_.publish();
}

void SnapshotFeed::take_round(Ticker& ticker, NodeIndex node, NodeView& view) {
  if (view.activity != Activity::Running && view.activity != Activity::Paused) return;
  view.round = ticker.tree().nodes[node].kind->round(ticker, node);
}

void SnapshotFeed::take_progress(Ticker& ticker, NodeIndex node,
                                 std::vector<NodeView>& views) const {
  views[node].limit = limit(ticker, node);
  NodeIndex child = node + 1;
  for (const double used : child_progress(ticker, node)) {
    views[child].progress = shown_progress(views[child].activity, used);
    child = ticker.end_of(child);
  }
}

}  // namespace lockstep
