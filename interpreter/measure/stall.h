// Finds who keeps the others waiting: a child of a synchronized node that is unfinished and ticked,
// and whose progress stands still for longer than a limit while at least one other child is held
// for it. The node itself cannot deadlock; a child that never advances makes it look so.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "measure/synchronized_measure.h"

namespace lockstep {

struct Standstill {
  NodeIndex node = 0;   // the synchronized node
  NodeIndex child = 0;  // who stands still
  Nanoseconds since{0};
  Nanoseconds time{0};  // now
  double progress = 0;
};

// One node. Each standstill is reported once: its end is a change of progress by more than 1e-9,
// or that nobody is held any more.
class StallDetector {
 public:
  StallDetector(std::size_t children, Nanoseconds limit) : limit_(limit), children_(children) {}

  // Returns the children (their number among the children) that have now stood still for too long;
  // valid until the next call. No allocation.
  std::span<const std::size_t> after_tick(const SynchronizedTick& tick);
  Nanoseconds since(std::size_t child) const { return children_[child].since; }

 private:
  struct Child {
    bool watched = false;
    bool reported = false;
    double progress = 0;
    Nanoseconds since{0};
  };
  bool stalls(Child& child, Nanoseconds time, double progress, bool suspect) const;

  Nanoseconds limit_;
  std::vector<Child> children_;
  std::vector<std::size_t> found_ = std::vector<std::size_t>(children_.size());
};

// All synchronized nodes of a tree.
class StallWatch {
 public:
  using Report = std::function<void(const Standstill&)>;
  StallWatch(const Tree& tree, Nanoseconds limit, Report report);

  void after_tick(Ticker& ticker, Nanoseconds time);

 private:
  struct Watched {
    SynchronizedProbe probe;
    StallDetector detector;
  };
  std::vector<Watched> nodes_;
  Report report_;
};

}  // namespace lockstep
