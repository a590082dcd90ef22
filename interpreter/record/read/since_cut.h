// The first line of a run that continues after a cut has the whole state, and leaves out what is as
// at the start of a run. This makes of it what a line is in a run without the cut: the changes.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "record/recording.h"

namespace lockstep::host {

class SinceCut {
 public:
  void take(const RecordedTick& tick);  // each one, with what complete() has added
  // At the cut: forgets the states of the nodes, so that the next line is read as that of a new
  // run.
  void cut(std::vector<RecordedState>& states, const Shape& shape);
  // Of the first tick after the cut: the entries that differ from those before it.
  std::vector<RecordedEntry> changed_entries(const RecordedTick& tick) const;
  // Adds to that tick what it left out. Valid until the next call.
  void complete(RecordedTick& tick);
  // The limits from before the cut, around the reading of each line: none for the line, which
  // leaves out 0, and after it those of nodes that no tick has reached since.
  void withdraw_limits(std::vector<RecordedState>& states) const;
  void restore_limits(std::vector<RecordedState>& states);
  void forget_limits() { limits_.clear(); }

 private:
  std::vector<std::optional<RecordedEntry>> entries_;  // by index
  std::set<NodeIndex> reasoned_, heard_from_;          // that have ever had one
  std::vector<NodeIndex> forgotten_, changed_;
  // Of synchronized nodes, in the last tick that reached them: a new process does not know it.
  using Limit = std::pair<NodeIndex, double>;
  std::vector<Limit> limits_;
  std::vector<RecordedReason> reasons_;
  std::vector<RecordedHeard> heard_;
  std::vector<std::uint32_t> set_;
};

}  // namespace lockstep::host
