// The largest change of the progress of one child of a parallel from one tick to the next, within
// an activation of the parallel. A parallel that ends does not change the progress of the children
// that have not succeeded.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "judge/measure/measure.h"

namespace lockstep::host {

class StepLength final : public Accumulator {
 public:
  explicit StepLength(const MeasureTarget& target) : place_(target.place), last_(target.children) {}

  void reset() override { running_ = false, longest_ = kNoValue; }
  // A change across it is not that of one tick.
  void join(Joint) override { running_ = false; }
  void after_tick(const TickView& view) override;
  // The same in parts, for who goes over the children for more than this: each child, if the node
  // was ticked, then the tick.
  void see(const SynchronizedTick& tick, std::size_t child) {
    const double progress = tick.progress[child];
    const double last = std::exchange(last_[child], progress);
    if (running_) take(std::abs(progress - last));
    // The next snapshot would show it, but there may be none.
    if (tick.succeeded[child]) take(std::abs(1 - progress));
  }
  void end_tick(const SynchronizedTick& tick) {
    if (tick.ticked) longest_ = std::fmax(longest_, 0);
    // Behind a joint, it has the progress of its children with its next tick.
    running_ = (running_ || tick.ticked) && tick.status == Status::Running;
  }
  double value(const EndView&) const override { return longest_; }

 private:
  void take(double step) {
    if (!(step <= longest_) && step >= 0) longest_ = step;  // none of a child that is left out
  }

  std::size_t place_;
  std::vector<double> last_;  // progress of each child
  bool running_ = false;      // after the last tick
  double longest_ = kNoValue;
};

}  // namespace lockstep::host
