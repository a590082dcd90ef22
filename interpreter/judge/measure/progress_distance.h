// How far the children of a parallel are apart, as the paper measures it: one sample for each tick
// of the parallel, taken before its children are ticked, completed children at 1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "judge/measure/measure.h"

namespace lockstep::host {

// The sum of |p_i - p_j| over all unordered pairs, of one list of numbers after the other. Their
// order is kept from list to list: as long as it does not change, the sum takes one pass.
class PairDistance {
 public:
  explicit PairDistance(std::size_t numbers);

  // No allocation.
  double of(std::span<const double> progress) {
    double sum = 0;
    if (progress.size() > kFew && is_ordered(progress, sum)) return sum;
    return progress.size() > kFew ? of_new_order(progress) : of_few(progress);
  }

 private:
  static constexpr std::size_t kFew = 16;

  bool is_ordered(std::span<const double> progress, double& sum) const;
  double of_new_order(std::span<const double> progress);
  double of_few(std::span<const double> progress);

  std::vector<double> sorted_;
  std::vector<std::uint32_t> order_;  // the places of the numbers, from the least; of many
};

class ProgressDistance : public Accumulator {
 public:
  // Which samples count, both included.
  struct Samples {
    std::uint64_t first = 0, last = std::numeric_limits<std::uint64_t>::max();
  };
  explicit ProgressDistance(const MeasureTarget& target) : ProgressDistance(target, Samples()) {}
  ProgressDistance(const MeasureTarget& target, Samples samples)
      : place_(target.place), range_(samples), distance_(target.children) {}

  void reset() override { seen_ = samples_ = 0, sum_ = 0; }
  void after_tick(const TickView& view) override;
  double value(const EndView&) const override { return samples_ == 0 ? kNoValue : sum_; }

  std::uint64_t samples() const { return samples_; }
  double sum() const { return sum_; }
  double mean() const { return samples_ == 0 ? 0.0 : sum_ / static_cast<double>(samples_); }

 private:
  std::size_t place_;
  Samples range_;
  PairDistance distance_;
  std::uint64_t seen_ = 0;  // samples, also those that do not count
  std::uint64_t samples_ = 0;
  double sum_ = 0;
};

}  // namespace lockstep::host
