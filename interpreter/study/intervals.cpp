#include "study/intervals.h"

#include <cmath>

#include "study/distributions.h"

namespace lockstep {
namespace {

constexpr double kTail = (1 - kConfidence) / 2;

}  // namespace

std::optional<Interval> median_interval(std::span<const double> sorted) {
  const auto below = fair_coin_quantile(sorted.size(), kTail);
  if (!below) return std::nullopt;
  return Interval{sorted[*below], sorted[sorted.size() - 1 - *below]};
}

Interval share_interval(std::uint64_t count, std::uint64_t all) {
  static const double z = normal_quantile(1 - kTail);
  const auto n = static_cast<double>(all);
  const double share = static_cast<double>(count) / n;
  const double weight = 1 + z * z / n;
  const double middle = (share + z * z / (2 * n)) / weight;
  const double half = z / weight * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  return {count == 0 ? 0 : middle - half, count == all ? 1 : middle + half};
}

}  // namespace lockstep
