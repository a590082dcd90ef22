// Finds a child that keeps the others waiting: the child with the least progress of a synchronized
// node whose least progress has not risen above its best so far for longer than a limit, while
// others are held. This also finds a child that moves without getting anywhere: one that starts
// again for ever, or one that loses while it is held what it gains while it is ticked.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/clock.h"
#include "measure/synchronized_measure.h"

namespace lockstep {

struct Standstill {
  NodeIndex node = 0;   // the synchronized node
  NodeIndex child = 0;  // the child with the least progress
  Nanoseconds since{0};
  Nanoseconds time{0};  // now
  double progress = 0;
  double best = 0;  // that the least progress was at in this activation
};

// One node. Each standstill is reported once. It ends with a new best, or when all children are at
// 1, where perpetual actions cannot rise.
class StallDetector {
 public:
  explicit StallDetector(Nanoseconds limit) : limit_(limit) {}

  // The child that has now held the others for too long. No allocation.
  std::optional<std::size_t> after_tick(const SynchronizedTick& tick);
  Nanoseconds since() const { return since_; }  // a child waits without a new best
  double best() const { return best_; }

 private:
  Nanoseconds limit_;
  bool runs_ = false;
  bool somebody_waits_ = false;
  bool reported_ = false;
  double best_ = 0;
  Nanoseconds since_{0};
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
