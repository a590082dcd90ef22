// A run after a tick, as columns over the nodes of its Shape: all that measures see of it, and
// whoever else watches, judges or draws it. Two make Moments: LiveMoments (run/live_moments.h) of
// a run, without a copy, and RecordedMoments (record/read/recorded_moments.h) of the lines of a
// recording. What is written over Moments is written once for both.
//
// Example: a ParallelAbsolute with the barrier 0.5 holds its child b. Then limit() of the parallel
// is 0.5, used() of it 0.2 and 0.5, held(b) is true and ticked(b) is false.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/blackboard/entry.h"
#include "base/core/clock.h"
#include "base/core/synchronization.h"
#include "trace/answer.h"
#include "trace/faults.h"
#include "trace/moments_view.h"
#include "trace/reason.h"

namespace lockstep::host {

// An entry as a recording shows it.
struct EntryText {
  std::optional<std::string> text = {};  // its value; none: too long to be shown, or there is none
  std::uint32_t writes = 0;              // how often it was written, as Entry::changes
};

// The last word that a robot has heard from another one of its team.
struct Heard {
  NodeIndex node = 0;      // that stands for the other robot
  std::uint32_t run = 0;   // of the other robot: RecordingHeader::run
  std::uint64_t word = 0;  // it was sent after so many ticks of that run; 0: none is heard yet
  Nanoseconds time{0};     // of the first tick of this run that knew it
};

// A run that goes on, for what no column has: it is computed when somebody asks.
class LiveRun {
 public:
  // Between two ticks, of any node; before a tick, for the time of that.
  virtual double progress(NodeIndex node) = 0;
  // Before a tick: asks each node once at most until then, whoever wants to know.
  virtual void share_progress() = 0;
  // Of a running node that repeats its child.
  virtual Round round(NodeIndex node) = 0;
  // Whether a member of a barrier beside the tree was held there in the last tick.
  virtual bool is_held_at_barrier(NodeIndex member) = 0;
  // A leaf has failed so that the run ends.
  virtual bool faulted() const = 0;
  // Faults since the last report, after which the run goes on.
  virtual std::span<const Fault> tolerated() const = 0;
  // In this run, one of each leaf.
  virtual std::span<const OutOfRange> out_of_range() const = 0;
  virtual std::span<const WentOn> went_on() const = 0;

 protected:
  ~LiveRun() = default;
};

struct Moment {
  std::uint64_t tick = 0;  // the first is 0
  Nanoseconds time{0};     // when it began, since the run began

  std::span<const Activity> activity = {};      // by node, and so are the next ones
  std::span<const std::uint32_t> reached = {};  // the number of the last tick that reached it
  std::uint32_t number = 0;                     // of this tick, as `reached` counts; 0: none yet
  // Before the tick, as its parent used it; 0 for what was left out. Only of nodes that are asked
  // for it. Without such nodes there is no column.
  std::span<const double> progress = {};
  std::span<const double* const> limits = {};          // null: the node has none
  std::span<const std::span<const double>> uses = {};  // empty: it compares no progress
  // How fast what a node that paces holds was to be; 0: as fast as it can. Null: of other nodes.
  std::span<const double* const> factors = {};
  // That have succeeded in the tick, and were ended later in it.
  std::span<const NodeIndex> ended = {};
  // That --stall-fail has ended in the tick: run/stall_fail.h.
  std::span<const NodeIndex> stood_still = {};
  MomentsView within = {};  // what happened within the tick
  // Of the nodes that have ever had one, in the order of their first ones.
  std::span<const Reason> reasons = {};

  // Given since the tick before.
  std::span<const GivenAnswer> answers = {};

  // In a team: of each node that stands for another robot.
  std::span<const Heard> heard = {};

  // By entry of the Shape; the one of a run, the other of a recording.
  std::span<const Entry> entries = {};
  std::span<const EntryText> texts = {};

  LiveRun* live = nullptr;  // null: of a recording

  Status status(NodeIndex node) const { return status_of(activity[node]); }
  bool held(NodeIndex node) const { return activity[node] == Activity::Paused; }
  bool ticked(NodeIndex node) const { return number != 0 && reached[node] == number; }
  NodeState state(NodeIndex node) const { return NodeState::of(activity[node], ticked(node)); }
  // Also where an ancestor has ended it since.
  bool has_succeeded(NodeIndex node) const {
    return status(node) == Status::Success || std::ranges::find(ended, node) != ended.end();
  }
  // Of a synchronized node in the last tick that reached it, and of a node that uses resources:
  // base/core/synchronization.h, base/core/resource_set.h.
  double limit(NodeIndex node) const { return *limits[node]; }
  // In (0, 1]; 1 is as fast as the node is by itself. Of what is not paced, and does not run: 1.
  double factor(NodeIndex node) const {
    const bool has_one = !factors.empty() && factors[node] != nullptr && *factors[node] != 0;
    return has_one && (ticked(node) || status(node) == Status::Running) ? *factors[node] : 1;
  }
  // Whether it is of the last tick of its leaf, which nothing has ended since. In a recording there
  // are no others.
  bool holds(const Reason& it) const {
    if (live == nullptr) return !it.text.empty();
    const bool is_of_last_tick = it.number != 0 && it.number == reached[it.node];
    return is_of_last_tick && (it.number == number || status(it.node) != Status::Idle);
  }
  std::string_view reason(NodeIndex node) const {
    const auto it = std::ranges::find(reasons, node, &Reason::node);
    return it != reasons.end() && holds(*it) ? std::string_view(it->text) : std::string_view();
  }
  // Of a run that goes on, as it is now; of a recording, as it was when the tick began.
  double progress_of(NodeIndex node) const {
    return live != nullptr ? live->progress(node) : progress[node];
  }
  // Whether a member of a barrier beside the tree is held there. Its child comes right behind it.
  bool is_held_at_barrier(NodeIndex member) const {
    return live != nullptr ? live->is_held_at_barrier(member) : held(member + 1);
  }
  // The progress of each child of a parallel, or of what a group holds, as the node used it in the
  // last tick in which it asked them; kLeftOut for one that was left out.
  std::span<const double> used(NodeIndex node) const { return uses[node]; }
};

// What the engine does not keep by itself: whoever makes Moments of a run is told who looks at it.
struct AskedOfRun {
  std::vector<NodeIndex> progress = {};   // Moment::progress of these
  std::vector<NodeIndex> parallels = {};  // Moment::used of these, also if they compare nothing
  bool within = false;                    // Moment::within
  bool progress_within = false;           // and MomentsView::progress
  // Of the observer that knows it: Moment::heard, which it changes before a tick.
  std::span<const Heard> heard = {};
  // Likewise: Moment::stood_still. Null: nothing ends what stands still.
  const std::vector<NodeIndex>* stood_still = nullptr;
};

// Whether a parallel, or a node beside the tree, asked its children in the tick. A tick in which a
// script of the parallel decided, or in which its `while` halted it, does not count.
inline bool asked_children(const Moment& moment, NodeIndex node,
                           std::span<const NodeIndex> children, bool is_group) {
  if (!moment.ticked(node) || is_group) return moment.ticked(node);
  return std::ranges::any_of(children, [&](NodeIndex child) { return moment.ticked(child); });
}

}  // namespace lockstep::host
