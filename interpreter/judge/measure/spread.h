// The largest distance between the most and the least advanced child of a parallel.
#pragma once

#include <algorithm>
#include <cmath>

#include "judge/measure/measure.h"

namespace lockstep::host {

// The least and the most progress in one tick; 1 and 0 of no child.
struct Extent {
  double least = 1, most = 0;

  void see(double progress) {  // no comparison is true for one that is left out
    if (progress < least) least = progress;
    if (progress > most) most = progress;
  }
};

class Spread final : public Accumulator {
 public:
  explicit Spread(const MeasureTarget& target) : place_(target.place) {}

  void reset() override { largest_ = kNoValue; }
  void after_tick(const TickView& view) override;
  void take(const Extent& extent) {
    largest_ = std::fmax(largest_, std::max(0.0, extent.most - extent.least));
  }
  double value(const EndView&) const override { return largest_; }

 private:
  std::size_t place_;
  double largest_ = kNoValue;
};

}  // namespace lockstep::host
