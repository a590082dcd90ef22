// The largest change of the progress of one child of a parallel from one tick to the next, within
// an activation of the parallel. A parallel that ends does not change the progress of the children
// that have not succeeded.
#pragma once

#include <vector>

#include "judge/measure/measure.h"

namespace lockstep::host {

class StepLength final : public Accumulator {
 public:
  explicit StepLength(const MeasureTarget& target) : place_(target.place), last_(target.children) {}

  void reset() override { running_ = false, longest_ = kNoValue; }
  void after_tick(const TickView& view) override;
  double value(const EndView&) const override { return longest_; }

 private:
  std::size_t place_;
  std::vector<double> last_;  // progress of each child
  bool running_ = false;      // after the last tick
  double longest_ = kNoValue;
};

}  // namespace lockstep::host
