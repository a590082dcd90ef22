// The Moments of a recording: each is what run/live_moments.h gave when that tick was recorded.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "record/recording.h"
#include "trace/moment.h"

namespace lockstep::host {

class RecordedMoments {
 public:
  // The header must outlive this.
  explicit RecordedMoments(const RecordingHeader& header);
  RecordedMoments(const RecordedMoments&) = delete;
  RecordedMoments& operator=(const RecordedMoments&) = delete;

  // Of the next tick. Valid until the next call.
  const Moment& read(const RecordedTick& tick);

 private:
  // What a node holds, and the progress of that as the node used it.
  struct Keeper {
    NodeIndex node = 0;
    bool is_plain = false;  // a parallel that compares no progress
    bool ignores_idle = false;
    bool holds_first = false;  // robots count 0 where they have not begun
    std::vector<NodeIndex> children = {};
    std::vector<NodeIndex> members = {};              // of a group: the parents of the children
    std::vector<std::vector<NodeIndex>> around = {};  // each member, below what has all members
    std::vector<double> used = {};
  };
  void add(const RecordingHeader& header, NodeIndex node);
  bool is_ticked_again(std::span<const NodeState> was, std::span<const NodeState> now) const;
  std::optional<std::size_t> asked_after(const Keeper& keeper, const MomentsView& moments);
  void read_used(Keeper& keeper, const RecordedTick& tick);
  double in_plain_parallel(const Keeper& keeper, std::size_t child, const RecordedTick& tick);
  bool is_ticked(const RecordedTick& tick, NodeIndex parallel, NodeIndex child);
  Status before(NodeIndex node) const;
  bool is_left_out(const Keeper& keeper, std::size_t child) const;
  void read_ended(const RecordedTick& tick);
  void read_stood_still(const RecordedTick& tick);

  const RecordingHeader& header_;
  std::vector<Activity> activity_;  // after the last tick that was read
  std::vector<std::uint32_t> reached_;
  std::vector<double> progress_, limit_, factor_;
  std::vector<const double*> limits_, factors_;
  std::vector<std::span<const double>> uses_;
  std::vector<NodeState> within_;  // before a node asked for the last time; empty: before the tick
  std::vector<NodeState> before_;  // the moment before, while moments are read
  std::vector<bool> is_guard_;     // it is ticked again after it has completed
  std::vector<bool> is_leaf_;
  std::vector<Keeper> keepers_;
  std::vector<NodeIndex> ended_, stood_still_;
  std::vector<EntryText> texts_;
  std::vector<Reason> reasons_;
  std::vector<Heard> heard_;
  bool names_children_;  // that have succeeded
  Moment moment_;
};

}  // namespace lockstep::host
