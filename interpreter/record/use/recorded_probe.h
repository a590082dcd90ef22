// Reads the ticks of parallels from a recording, as SynchronizedProbe does from a Ticker. Used by
// everything that measures or draws recordings.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "judge/measure/synchronized_measure.h"
#include "record/recording.h"

namespace lockstep::host {

class RecordedProbe {
 public:
  RecordedProbe(const RecordingHeader& header, NodeIndex node);
  // Valid until the next call.
  SynchronizedTick read(const RecordedTick& tick);

  NodeIndex node() const { return node_; }
  const std::vector<NodeIndex>& children() const { return children_; }
  // The end of each child's path.
  const std::vector<std::string>& names() const { return names_; }
  const Guards& guards() const { return guards_; }

 private:
  void find_around(const RecordingHeader& header);
  double in_plain_parallel(std::size_t child, const RecordedState& state) const;
  bool asked_children(const RecordedTick& tick) const;
  bool has_succeeded(NodeIndex child, const RecordedTick& tick) const;
  bool is_left_out(std::size_t child) const;
  bool is_in_skipped(std::size_t child, const RecordedTick& tick) const;

  // The nodes around each member of a group, below the node that has all members, and whether some
  // of these nodes were skipped in the last tick.
  struct Skips {
    std::vector<std::vector<NodeIndex>> around;
    std::vector<bool> found;
  };

  NodeIndex node_;
  std::vector<NodeIndex> children_;
  std::vector<std::string> names_;
  std::vector<NodeIndex> members_;  // of a group: the parents of the children
  std::unique_ptr<Skips> skips_;
  std::vector<double> used_;
  Guards guards_;
  HeldChildren held_;
  bool synchronizes_;
  bool ignores_idle_ = false, is_pool_ = false, names_succeeded_ = false;
  std::vector<Status> last_;  // of each child, or member, after the last tick
  bool runs_ = false;         // after the last tick
};

// A synchronized node and its measures.
struct RecordedMeasure {
  RecordedProbe probe;
  SynchronizedMeasure measure;

  void after_tick(const RecordedTick& tick) { measure.after_tick(probe.read(tick)); }
};

// One for each synchronized node.
std::vector<RecordedMeasure> measures_of(const RecordingHeader& header);

}  // namespace lockstep::host
