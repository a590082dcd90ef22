// The measures of one synchronized node that the summary of a run and `lockstep log info` report,
// and how a Ticker's ticks of one parallel are read.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/tree.h"
#include "judge/measure/fall.h"
#include "judge/measure/held.h"
#include "judge/measure/progress_distance.h"
#include "judge/measure/spread.h"
#include "judge/measure/step_length.h"

namespace lockstep::host {

class Ticker;

// The nodes of the tree that keep their children in step, in pre-order, and the pools.
std::vector<NodeIndex> synchronized_nodes(const Tree& tree);
// The nodes that the node may hold: the children of a parallel; of a group, what its members hold.
std::vector<NodeIndex> children_of(const Tree& tree, NodeIndex node);

// Finds from the states after each tick which children their node held in that tick.
// It also keeps which children have succeeded: SynchronizedTick::succeeded.
class HeldChildren {
 public:
  explicit HeldChildren(std::size_t children)
      : flags_(std::make_unique<bool[]>(3 * children)), children_(children) {}

  // `reached`: by the tick, or nobody asked; `held`: its ticks are still withheld.
  void set(std::size_t child, Status status, bool reached, bool held) {
    bool& running = flags_[children_ + child];  // after the last tick
    flags_[child] = held || (status == Status::Idle && running && !reached);
    running = status == Status::Running;
  }
  // The answer of a pool decides alone, also about a child that has not begun.
  void set(std::size_t child, bool waits) { flags_[child] = waits; }
  void set_succeeded(std::size_t child, bool succeeded) {
    flags_[2 * children_ + child] = succeeded;
  }
  std::span<const bool> held() const { return {flags_.get(), children_}; }
  std::span<const bool> succeeded() const { return {flags_.get() + 2 * children_, children_}; }

 private:
  std::unique_ptr<bool[]> flags_;  // held, running, succeeded
  std::size_t children_;
};

// Which children of a parallel, or members of a barrier, are guards: they contain no action, and
// are part of no measure.
class Guards {
 public:
  Guards() = default;
  explicit Guards(std::vector<bool> guards);

  std::size_t count() const { return places_.size(); }
  // The progress of the children without that of the guards. Valid until the next call.
  std::span<const double> leave_out(std::span<const double> progress);

 private:
  std::vector<std::size_t> places_;
  std::vector<double> others_;  // where there are guards
};

class SynchronizedMeasure {
 public:
  SynchronizedMeasure(std::size_t children, const Guards& guards, Synchronization synchronization,
                      bool is_group);

  void join() { falls_.join(); }  // the run, later than at its first tick
  void after_tick(const SynchronizedTick& tick);
  void run_ended(Nanoseconds time);

  const ProgressDistance& distance() const { return distance_; }
  double largest_spread() const { return spread_.value({}); }
  double step_length() const { return step_length_.value({}); }
  // The spread cannot be larger: what the limits allowed, and the longest step. Nothing if progress
  // fell, or rose while it was held or before the first tick that counts, or a child that was left
  // out may have joined from far behind.
  std::optional<double> bound() const;
  bool is_pool() const { return synchronization_ == Synchronization::Resources; }
  const FallWatch& falls() const { return falls_; }
  std::span<const HeldChild> held() const { return held_; }

 private:
  ProgressDistance distance_;
  Spread spread_;
  StepLength step_length_;
  std::size_t guards_;
  Synchronization synchronization_;
  bool left_out_ = false;  // another child than a guard, in some tick
  double widest_ = 0;      // between the least progress and the farthest that was allowed
  FallWatch falls_;
  std::vector<HeldChild> held_;
};

// Reads the ticks of one parallel from a Ticker. No allocation after it is made.
class SynchronizedProbe {
 public:
  // Without `with_flags` its ticks do not say which children are held or have succeeded.
  SynchronizedProbe(const Tree& tree, NodeIndex node, bool with_flags = true);
  // A plain parallel does not store the progress of its children, so this reads it.
  void before_tick(Ticker& ticker) {
    if (!progress_.empty()) read_progress(ticker);
  }
  // Valid until the next call.
  SynchronizedTick read(Ticker& ticker, Nanoseconds time) {
    SynchronizedTick tick;
    read(ticker, time, tick);
    return tick;
  }
  // The same into what it has given before.
  void read(Ticker& ticker, Nanoseconds time, SynchronizedTick& tick);

  NodeIndex node() const { return node_; }
  std::span<const NodeIndex> children() const { return children_; }
  const Guards& guards() const { return guards_; }

 private:
  void read_progress(Ticker& ticker);
  void read_held(Ticker& ticker, bool asked);
  void read_succeeded(Ticker& ticker, SynchronizedTick& tick);

  NodeIndex node_;
  std::vector<NodeIndex> children_;
  bool is_group_;
  bool with_flags_;
  bool is_pool_;
  HeldChildren held_;
  Guards guards_;
  std::vector<double> progress_;  // only where the node does not synchronize
};

}  // namespace lockstep::host
