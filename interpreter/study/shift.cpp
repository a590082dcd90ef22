#include "study/shift.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/nth_sum.h"
#include "study/rank_tests.h"
#include "study/ranks.h"

namespace lockstep::host {
namespace {

using Values = std::vector<double>;

Values sorted(std::span<const double> values) {
  Values copy(values.begin(), values.end());
  std::ranges::sort(copy);
  return copy;
}

// A shift is tested by how many of `count` numbers are above it; their mean is half of them. The
// least number of them that the test does not reject.
std::uint64_t least_accepted(std::uint64_t count, double variance) {
  const double mean = static_cast<double>(count) / 2;
  std::uint64_t low = 0, high = count / 2;
  while (low < high) {
    const std::uint64_t above = low + (high - low) / 2;
    if (rank_sum_p(static_cast<double>(above) - mean, variance) < 1 - kConfidence) {
      low = above + 1;
    } else {
      high = above;
    }
  }
  return low;
}

// The median of `count` numbers, of which `nth` gives the n-th smallest.
template <class Nth>
double median_among(std::uint64_t count, Nth nth) {
  const double low = nth((count - 1) / 2), high = nth(count / 2);
  return low + (high - low) / 2;
}

// Shifts that are not among the numbers have the ties of the samples only, so the variance is the
// same for all.
template <class Nth>
Shift shift_among(std::uint64_t count, double variance, Nth nth) {
  Shift shift{.estimate = median_among(count, nth)};
  const std::uint64_t outside = least_accepted(count, variance);
  if (outside > 0) shift.interval = Interval{nth(outside - 1), nth(count - outside)};
  return shift;
}

// Of few differences: each shift is tested, from the outside to the first that is not rejected.
// Between two neighbors of the means of each two, all shifts have the same ranks.
class ExactShifts {
 public:
  explicit ExactShifts(const Values& differences) : differences_(differences) {
    Values roundings;
    for (std::size_t i = 0; i < differences.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const double low = differences[j], high = differences[i];
        means_.push_back(low + (high - low) / 2);
        roundings.push_back(rounding_of(std::max(std::abs(low), std::abs(high))));
      }
    }
    tie_equal(means_, roundings);
    std::ranges::sort(means_);
    means_.erase(std::unique(means_.begin(), means_.end()), means_.end());
  }

  // With the estimate: where most differences are equal, it may be rejected, or each shift. Nothing
  // if no shift is rejected.
  std::optional<Interval> accepted(double estimate) const {
    // Beyond all means each difference has the same sign: one choice of signs of all.
    if (std::ldexp(2, -static_cast<int>(differences_.size())) >= 1 - kConfidence)
      return std::nullopt;
    const std::size_t last = means_.size() - 1;
    std::size_t low = 0, high = last;
    while (low < last && means_[low] < estimate && !is_any_accepted(low, low)) ++low;
    while (high > 0 && means_[high] > estimate && !is_any_accepted(high, high - 1)) --high;
    return Interval{std::min(means_[low], estimate), std::max(means_[high], estimate)};
  }

 private:
  // A mean, and the shifts between one and the next.
  bool is_any_accepted(std::size_t mean, std::size_t gap) const {
    return is_accepted(means_[mean]) ||
           is_accepted(means_[gap] + (means_[gap + 1] - means_[gap]) / 2);
  }
  bool is_accepted(double shift) const {
    Values shifted, roundings;
    for (const double value : differences_) {
      shifted.push_back(value - shift);
      roundings.push_back(rounding_of(std::max(std::abs(value), std::abs(shift))));
    }
    tie_differences(shifted, roundings);
    return signed_rank(shifted).p >= 1 - kConfidence;
  }

  const Values& differences_;
  Values means_;
};

}  // namespace

Shift shift_between(std::span<const double> first, std::span<const double> second) {
  Values minus(first.begin(), first.end());
  for (double& value : minus) value = -value;
  const Values x = sorted(minus), y = sorted(second);
  const double variance =
      rank_sum_variance(static_cast<double>(x.size()), static_cast<double>(y.size()),
                        ranks_of(first).ties + ranks_of(second).ties);
  return shift_among(std::uint64_t{x.size()} * y.size(), variance,
                     [&](std::uint64_t n) { return nth_sum(x, y, n); });
}

Shift shift_of(std::span<const double> differences) {
  const Values x = sorted(differences);
  const std::uint64_t means = std::uint64_t{x.size()} * (x.size() + 1) / 2;
  const auto nth = [&](std::uint64_t n) { return nth_own_sum(x, n) / 2; };
  if (x.size() <= kMostExactPairs) {
    const double estimate = median_among(means, nth);
    return {estimate, ExactShifts(x).accepted(estimate)};
  }
  return shift_among(
      means, signed_rank_variance(static_cast<double>(x.size()), 0, ranks_of(differences).ties),
      nth);
}

}  // namespace lockstep::host
