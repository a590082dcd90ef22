// What is measured of one synchronized node over a run: its progress distance, and how long each
// child was held. Fed once per tick of the run, from a Ticker or from a recording.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/clock.h"
#include "engine/tree.h"
#include "measure/progress_distance.h"

namespace lockstep {

class Ticker;

// The nodes of the tree that keep their children in step, in pre-order.
std::vector<NodeIndex> synchronized_nodes(const Tree& tree);
std::vector<NodeIndex> children_of(const Tree& tree, NodeIndex node);

// Of one node, after a tick of the run.
struct SynchronizedTick {
  Nanoseconds time{0};           // when the tick of the run began, since the run began
  bool ticked = false;           // did the tick reach the node? If not, only the time counts.
  Status status = Status::Idle;  // Success also when an ancestor has ended the node since
  double limit = 0;              // that counted: engine/synchronized.h
  std::span<const double> progress = {};  // of each child, as the node used it in this tick
  // Of each child: it was running and did not get this tick. It may have been halted since.
  std::span<const bool> held = {};
};

// Tells from the states after each tick which children their node held in it.
class HeldChildren {
 public:
  explicit HeldChildren(std::size_t children)
      : running_(std::make_unique<bool[]>(children)), held_(std::make_unique<bool[]>(children)) {}

  // `reached`: by the tick; `held`: its ticks are still withheld.
  void set(std::size_t child, Status status, bool reached, bool held) {
    held_[child] = held || (status == Status::Idle && running_[child] && !reached);
    running_[child] = status == Status::Running;
  }
  const bool* data() const { return held_.get(); }

 private:
  std::unique_ptr<bool[]> running_;  // after the last tick
  std::unique_ptr<bool[]> held_;
};

class SynchronizedMeasure {
 public:
  explicit SynchronizedMeasure(std::size_t children) : distance_(children), held_(children) {}

  // As new, for the next run. No allocation.
  void reset();
  void after_tick(const SynchronizedTick& tick);
  void run_ended(Nanoseconds time) { pass_time(time); }

  struct Held {
    bool now = false;
    Nanoseconds time{0};  // from a tick in which it is held to the next, or to the end of the run
    std::uint64_t ticks = 0;
    std::uint64_t waits = 0;  // ticks in a row of the node are one
    bool is_waiting = false;  // also while the node itself is held
  };
  const ProgressDistance& distance() const { return distance_; }
  // Only what this node withheld: while the node itself is held, its children are not counted.
  std::span<const Held> held() const { return held_; }

 private:
  void pass_time(Nanoseconds time);

  ProgressDistance distance_;
  std::vector<Held> held_;
  Nanoseconds last_{0};
};

// Reads the ticks of one node from a Ticker. No allocation after it is made.
class SynchronizedProbe {
 public:
  SynchronizedProbe(const Tree& tree, NodeIndex node);
  // Valid until the next call.
  SynchronizedTick read(Ticker& ticker, Nanoseconds time);

  NodeIndex node() const { return node_; }
  std::span<const NodeIndex> children() const { return children_; }

 private:
  NodeIndex node_;
  std::vector<NodeIndex> children_;
  HeldChildren held_;
};

}  // namespace lockstep
