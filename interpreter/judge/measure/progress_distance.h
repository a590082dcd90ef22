// How far the children of a parallel are apart, as the paper measures it: one sample for each tick
// of the parallel, taken before its children are ticked, completed children at 1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "judge/measure/measure.h"

namespace lockstep::host {

// The sum of |p_i - p_j| over all unordered pairs. `scratch` must be as long as `progress`; what
// it holds afterwards has no meaning. O(n log n), no allocation.
double progress_distance(std::span<const double> progress, std::span<double> scratch);

class ProgressDistance : public Accumulator {
 public:
  // Which samples count, both included.
  struct Samples {
    std::uint64_t first = 0, last = std::numeric_limits<std::uint64_t>::max();
  };
  explicit ProgressDistance(const MeasureTarget& target) : ProgressDistance(target, Samples()) {}
  ProgressDistance(const MeasureTarget& target, Samples samples)
      : place_(target.place), range_(samples), scratch_(target.children) {}

  void reset() override { seen_ = samples_ = 0, sum_ = 0; }
  void after_tick(const TickView& view) override;
  double value(const EndView&) const override { return samples_ == 0 ? kNoValue : sum_; }

  std::uint64_t samples() const { return samples_; }
  double sum() const { return sum_; }
  double mean() const { return samples_ == 0 ? 0.0 : sum_ / static_cast<double>(samples_); }

 private:
  std::size_t place_;
  Samples range_;
  std::vector<double> scratch_;
  std::uint64_t seen_ = 0;  // samples, also those that do not count
  std::uint64_t samples_ = 0;
  double sum_ = 0;
};

}  // namespace lockstep::host
