// The largest distance between the most and the least advanced child of a parallel.
#pragma once

#include "judge/measure/measure.h"

namespace lockstep::host {

class Spread final : public Accumulator {
 public:
  explicit Spread(const MeasureTarget& target) : place_(target.place) {}

  void reset() override { largest_ = kNoValue; }
  void after_tick(const TickView& view) override;
  double value(const EndView&) const override { return largest_; }

 private:
  std::size_t place_;
  double largest_ = kNoValue;
};

}  // namespace lockstep::host
