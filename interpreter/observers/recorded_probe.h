// Reads the ticks of one synchronized node from a recording, as SynchronizedProbe does from a
// Ticker. Used by all that measures or draws recordings.
#pragma once

#include <string>
#include <vector>

#include "measure/synchronized_measure.h"
#include "observers/recording.h"

namespace lockstep {

std::vector<NodeIndex> synchronized_nodes(const RecordingHeader& header);

class RecordedProbe {
 public:
  RecordedProbe(const RecordingHeader& header, NodeIndex node);
  // Valid until the next call.
  SynchronizedTick read(const RecordedTick& tick);

  NodeIndex node() const { return node_; }
  const std::vector<NodeIndex>& children() const { return children_; }
  // The last segment of each child's path.
  const std::vector<std::string>& names() const { return names_; }

 private:
  NodeIndex node_;
  std::vector<NodeIndex> children_;
  std::vector<std::string> names_;
  std::vector<double> progress_;
  HeldChildren held_;
};

}  // namespace lockstep
