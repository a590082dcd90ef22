// Publishes the state of a run as snapshots, ten times a second at most. The tick thread only
// copies the state of the nodes and what has changed of the blackboard, equally often, into a
// lock-free buffer; another thread takes the newest. After the first snapshots, a tick allocates
// only for lines that leaves log and for entries whose text grows.
#pragma once

#include <vector>

#include "base/core/clock.h"
#include "base/core/triple_buffer.h"
#include "judge/measure/entry_changes.h"
#include "judge/measure/synchronized_ticks.h"
#include "record/live/snapshot.h"
#include "run/leaf_lines.h"

namespace lockstep::host {

class SnapshotFeed final : public Observer {
 public:
  static constexpr std::chrono::milliseconds kPeriod{100};

  using RealTime = Nanoseconds (*)();

  // Watches all entries of the tree. `real_time` is for tests.
  explicit SnapshotFeed(const Shape& shape, RealTime real_time = monotonic_now);

  // Takes a line that a leaf has logged, for a consumer that shows it from snapshots. May be called
  // from any thread.
  void log(std::string_view who, std::string_view level, std::string_view text);

  void run_started(const Moment& moment, const RunStart& start) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  // Publishes a snapshot that was held back: no tick follows for a while.
  void standing(const Moment& moment) override;
  // Everything has been halted by then; the last snapshot is that of the last tick.
  void run_ended(const Moment& moment, const RunEnd& end) override;

  // For one thread. True if there is a newer snapshot, which newest() is from then on.
  bool take() { return snapshots_.take(); }
  const Snapshot& newest() const { return snapshots_.front(); }

 private:
  void take_entries(const Moment& moment, std::uint64_t tick);
  void take_logs();
  void publish(const Moment& moment);
  void take_progress(const Moment& moment, std::vector<NodeView>& views) const;

  RealTime real_time_;
  std::vector<SynchronizedTicks> compared_;
  std::vector<NodeIndex> users_, repeating_;
  Snapshot::Header header_;
  std::vector<Activity> activity_;  // after the last tick
  EntryChanges changes_;
  std::vector<EntryState> entries_;  // likewise
  LeafLines lines_;
  RecentLines logs_;
  Nanoseconds published_{0};
  bool is_shown_ = true;  // the last tick is published
  TripleBuffer<Snapshot> snapshots_;
};

}  // namespace lockstep::host
