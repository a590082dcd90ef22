// The paper's predictability distance: how far from an expected time an action reaches a given
// progress.
#pragma once

#include <cstdint>
#include <limits>

#include "judge/measure/measure.h"

namespace lockstep::host {

// The first instant of a run at which the progress was nearest to a target. Gaps that differ by
// less than 1e-9 are equal, so the first of them counts. Samples come in the order of time.
class NearestInstant {
 public:
  explicit NearestInstant(double target) : target_(target) {}

  void sample(double time, double progress);

  bool empty() const { return gap_ == std::numeric_limits<double>::infinity(); }
  double time() const { return time_; }  // in the unit of the samples; 0 when empty
  double gap() const { return gap_; }    // |progress - target| at that time
  // Whether the progress was ever at the target, or on both sides of it.
  bool reached() const;

 private:
  double target_;
  double time_ = 0;
  double gap_ = std::numeric_limits<double>::infinity();
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -std::numeric_limits<double>::infinity();
};

// The predictability of one node, in ticks, which count from 0.
class Predictability final : public Accumulator {
 public:
  Predictability(NodeIndex node, double target, double expected)
      : node_(node), target_(target), expected_(expected) {}

  void reset() override { *this = Predictability(node_, target_, expected_); }
  void after_tick(const TickView& view) override;

  // The instant minus the expected one; negative is early. The progress after the last tick counts
  // as one more sample. NaN: the progress did not reach the target.
  double value(const EndView&) const override;
  // How far from the target the progress was at that instant. NaN: no tick reached the node.
  double gap() const override;

 private:
  NearestInstant nearest() const;

  NodeIndex node_;
  double target_, expected_;
  NearestInstant nearest_{target_};
  double ticks_ = 0;
  bool ticked_ = false;
  bool succeeded_ = false;
};

}  // namespace lockstep::host
