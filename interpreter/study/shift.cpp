#include "study/shift.h"

#include <algorithm>
#include <vector>

#include "study/nth_sum.h"
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

// The shift among `count` numbers, of which `nth` gives the n-th smallest. Shifts that are not
// among them have the ties of the samples only, so the variance is the same for all.
template <class Nth>
Shift shift_among(std::uint64_t count, double variance, Nth nth) {
  const double low = nth((count - 1) / 2), high = nth(count / 2);
  Shift shift{.estimate = low + (high - low) / 2};
  const std::uint64_t outside = least_accepted(count, variance);
  if (outside > 0) shift.interval = Interval{nth(outside - 1), nth(count - outside)};
  return shift;
}

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
  const double variance =
      signed_rank_variance(static_cast<double>(x.size()), 0, ranks_of(differences).ties);
  return shift_among(std::uint64_t{x.size()} * (x.size() + 1) / 2, variance,
                     [&](std::uint64_t n) { return nth_own_sum(x, n) / 2; });
}

}  // namespace lockstep::host
