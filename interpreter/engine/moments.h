// Keeps the moments of a tick (trace/moments_view.h), for those who watch a run.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/run_state.h"
#include "trace/moments_view.h"

namespace lockstep::host {

class NodeContext;

// Without an allocation in a tick. Nothing is done in a tick of one moment.
class Moments {
 public:
  // Moments in a row that are equal are kept once. What has no room is counted: NodeTotals.
  static constexpr std::size_t kMost = 256;
  static constexpr std::size_t kMostChanges = 1024;  // and one for each node

  explicit Moments(NodeContext& context);

  // Asks running leaves for their progress at the start of each moment, of a tick that has several.
  // The first must have been asked before the tick: NodeContext::share_progress.
  void keep_progress();
  // The most changes that a tick can have.
  static std::size_t most_changes(std::size_t nodes) { return kMostChanges + 2 * nodes; }

  MomentsView view() const {
    return {first_, moments_, changes_, std::span(rest_).first(rests_), progress_};
  }

  // --- for the engine ----------------------------------------------------------------------------

  // The most numbers of progress that a tick can have.
  static std::size_t most_progress(std::size_t leaves) { return kMostChanges + leaves; }

  void begin_tick(const RunState& state);
  bool in_tick() const { return in_tick_; }
  // When this moment began.
  bool was_running(NodeIndex node) const { return now_[node].status() == Status::Running; }
  // Whether it was decided in this moment that a held node gets no tick.
  bool is_withheld(NodeIndex held) const;
  // A new moment begins. The node `under`, if there is one, and those above it are in their ticks,
  // so the engine has not stored their statuses yet: they run.
  void next(RunState& state, std::optional<NodeIndex> under);
  // The same when the whole tree is ticked again in the tick that has just ended.
  void reopen(RunState& state);
  // The root has been ticked.
  void end_tick(RunState& state);
  // The parent of what is halted, until `next` is not in that any more; see
  // NodeContext::halt_range.
  std::optional<NodeIndex> halts_under;

 private:
  void mark(RunState& state);
  void unmark(RunState& state);
  void look(const RunState& state, std::optional<NodeIndex> under);
  bool is_decided(NodeIndex held, std::optional<NodeIndex> under) const;
  void decide_holds(std::optional<NodeIndex> under);
  void keep();
  void count();
  bool add_changes(std::size_t most);
  bool add_progress();
  void ask_progress(bool is_first);

  NodeContext& context_;
  const Tree& tree_;
  std::vector<NodeState> first_, last_, now_;
  std::vector<NodeState> counted_;     // the state up to which `totals_` counts
  std::vector<NodeIndex> open_holds_;  // of an earlier tick: this one has not decided on them yet
  std::vector<TickMoment> moments_;
  std::vector<MomentChange> changes_;
  std::vector<NodeTotals> totals_, rest_;
  std::size_t rests_ = 0;
  std::vector<LeafProgress> progress_;
  // Of each leaf at the start of this moment, and of the one that was kept last; empty: it is not
  // kept.
  std::vector<double> leaves_, kept_leaves_;
  bool in_tick_ = false, is_full_ = false;
};

}  // namespace lockstep::host
