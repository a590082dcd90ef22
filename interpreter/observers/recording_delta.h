// What has changed in each node since the last line of a recording. A line that the file did not
// take is as if it had not been: the next holds its changes too. Used by recorder.
#pragma once

#include <fmt/format.h>

#include <vector>

#include "observers/recording.h"

namespace lockstep {

class RecordingDelta {
 public:
  explicit RecordingDelta(const Tree& tree);

  // Asks every running node for its progress.
  void before_tick(Ticker& ticker);
  // Appends the nodes that differ from what was kept last, as the recording writes them.
  void append(Ticker& ticker, fmt::memory_buffer& out);
  // What was appended last has reached the file.
  void keep();

 private:
  void take_snapshots(Ticker& ticker);

  std::vector<NodeIndex> synchronized_nodes_;
  std::vector<double> progress_;  // at the start of this tick
  std::vector<RecordedState> kept_;
  struct Change {
    NodeIndex node;
    RecordedState state;
  };
  std::vector<Change> changes_;  // of what was appended last
};

}  // namespace lockstep
