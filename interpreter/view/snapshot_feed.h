// Publishes the state of a run as snapshots, ten times a second at most. The tick thread only
// copies the state of the nodes, equally often, into a lock-free buffer; another thread takes the
// newest.
#pragma once

#include <vector>

#include "core/clock.h"
#include "view/snapshot.h"
#include "view/triple_buffer.h"

namespace lockstep {

class SnapshotFeed final : public Observer {
 public:
  static constexpr std::chrono::milliseconds kPeriod{100};

  explicit SnapshotFeed(const Tree& tree);

  void run_started(Ticker& ticker, const RunStart& start) override;
  void after_tick(Ticker& ticker, const TickReport& report) override;
  // Everything has been halted by then; the last snapshot is that of the last tick.
  void run_ended(Ticker& ticker, const RunEnd& end) override;

  // For one thread. True if there is a newer snapshot, which newest() is from then on.
  bool take() { return snapshots_.take(); }
  const Snapshot& newest() const { return snapshots_.front(); }

 private:
  void publish(Ticker& ticker);
  void take_progress(Ticker& ticker, NodeIndex node, std::vector<NodeView>& views) const;
  static void take_round(Ticker& ticker, NodeIndex node, NodeView& view);

  std::vector<NodeIndex> synchronized_nodes_, repeating_nodes_;
  Snapshot::Header header_;
  std::vector<Activity> activity_;  // after the last tick
  Nanoseconds published_{0};
  TripleBuffer<Snapshot> snapshots_;
};

}  // namespace lockstep
