// Finds what has changed in each node since the last line of a recording. If the file did not
// accept a line, the next one has its changes too. Unchanged nodes cost almost nothing: they are
// compared eight at a time. Used by recorder.
#pragma once

#include <string>
#include <vector>

#include "record/packet.h"
#include "trace/moment.h"
#include "trace/shape.h"

namespace lockstep::host {

class RunDelta {
 public:
  explicit RunDelta(const Shape& shape);

  // Asks every running node for its progress.
  void before_tick(const Moment& moment);
  // After the tick: the nodes that differ from the last accepted line. Valid until the next call.
  std::span<const NodeChange> changes(const Moment& moment);
  // The synchronized nodes and the children of parallels that have succeeded in the tick and are
  // idle again, because an ancestor has ended them. Valid until the next call.
  std::span<const NodeIndex> succeeded(const Moment& moment);
  // All nodes that succeeded() may have: among them the synchronized ones.
  std::size_t most_succeeded() const { return measured_.size(); }
  // The synchronized nodes that the tick reached whose limit is not what was kept. Valid until the
  // next call.
  std::span<const LimitChange> limits(const Moment& moment);
  // Of what nodes that pace hold: the factors that are not what was kept. Valid until the next
  // call.
  std::span<const FactorChange> factors(const Moment& moment);
  // The reasons of leaves that are not what was kept. Valid until the next call. Allocates for the
  // first one of a leaf.
  std::span<const ReasonChange> reasons(const Moment& moment);
  // The words of other robots that are not what was kept. Valid until the next call.
  std::span<const Heard> heard(const Moment& moment);
  // About the last result of changes(): a node has another status than what was kept, or is held or
  // was ticked where it was not, or the other way round; and a node has begun.
  bool has_turns() const { return has_turns_; }
  bool has_begun() const { return has_begun_; }
  // About the last result of changes(): the running leaves of which another number than their
  // progress was compared, with their progress. Valid until the next call.
  std::span<const LeafProgress> own_progress() const { return own_progress_; }
  // The rounds that are not what was kept. Valid until the next call.
  std::span<const RoundChange> rounds(const Moment& moment);
  // The next results of all of these also have all that differs from the state
  // before a run, until keep().
  void add_whole() { is_whole_ = true; }
  // Call when the file has accepted the last results of all of these.
  void keep();
  // Forgets what was kept: the next results have all that differs from the state before a run.
  void start_over();

 private:
  void set_progress(NodeIndex node, double progress);
  void add_change(NodeIndex node);
  void take_used(const Moment& moment);
  void forget_heard();

  // A node that compares the progress of others, and these.
  struct Keeper {
    NodeIndex node;
    std::vector<NodeIndex> held;
    bool is_group;
  };
  std::vector<Keeper> keepers_;
  std::vector<bool> is_leaf_;
  std::vector<LeafProgress> own_progress_;
  std::vector<NodeIndex> measured_;  // that succeeded() may have
  std::vector<NodeIndex> succeeded_;
  std::vector<LimitChange> kept_limits_;  // of each synchronized node, then of users of resources
  std::size_t first_user_ = 0;            // of these
  bool all_limits_ = false;  // nothing was kept; kept_limits_ still has what the last ticks said
  std::vector<LimitChange> limits_;
  std::vector<RoundChange> kept_rounds_;  // of each node that repeats its child
  std::vector<RoundChange> rounds_;
  std::vector<FactorChange> kept_factors_;
  std::vector<FactorChange> factors_;
  std::vector<std::string> kept_reasons_;  // in the order of Moment::reasons
  std::vector<ReasonChange> reasons_;
  std::vector<Heard> kept_heard_;  // in the order of Moment::heard
  std::vector<Heard> heard_;
  std::vector<double> progress_;      // at the start of this tick
  std::vector<std::uint8_t> source_;  // the Activity that it is of, where it follows from that

  // A node's state is its Activity, kTicked, and kMoved when its progress is not what was kept.
  std::vector<std::uint8_t> moved_;  // kMoved, or 0
  std::vector<std::uint8_t> state_;
  std::vector<std::uint8_t> kept_;
  std::vector<double> kept_progress_;

  std::vector<NodeChange> changes_;
  std::size_t count_ = 0;  // of these
  bool has_turns_ = false, has_begun_ = false;
  bool is_whole_ = false;
};

}  // namespace lockstep::host
