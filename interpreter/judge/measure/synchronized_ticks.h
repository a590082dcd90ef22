// The ticks of one parallel, barrier or pool, read from the Moments of a run, in their order: the
// progress of its children, and which of them are held.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "judge/measure/tick_view.h"
#include "trace/shape.h"

namespace lockstep::host {

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
  // All run, and none is held.
  void set_all_run() {
    if (std::exchange(all_run_, true)) return;
    std::fill_n(flags_.get(), children_, false);
    std::fill_n(flags_.get() + children_, children_, true);
    std::fill_n(flags_.get() + 2 * children_, children_, false);
  }
  void set_others() { all_run_ = false; }
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
  bool all_run_ = false;
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

// No allocation after it is made.
class SynchronizedTicks {
 public:
  // Without `with_flags` its ticks do not say which children are held or have succeeded.
  SynchronizedTicks(const Shape& shape, NodeIndex node, bool with_flags = true);

  // Valid until the next call.
  SynchronizedTick read(const Moment& moment) {
    SynchronizedTick tick;
    read(moment, tick);
    return tick;
  }
  // The same into what it has given before.
  void read(const Moment& moment, SynchronizedTick& tick);

  NodeIndex node() const { return node_; }
  std::span<const NodeIndex> children() const { return children_; }
  const Guards& guards() const { return guards_; }

 private:
  bool all_run(const Moment& moment) const;
  void read_flags(const Moment& moment, bool asked);
  void read_held(const Moment& moment, bool asked);

  NodeIndex node_;
  std::vector<NodeIndex> children_;
  std::vector<NodeIndex> members_;  // of a group: the parents of the children
  bool is_group_, is_pool_, compares_;
  bool are_leaves_;  // all children, so that they are next to each other; and many
  bool with_flags_;
  HeldChildren held_;
  Guards guards_;
};

}  // namespace lockstep::host
