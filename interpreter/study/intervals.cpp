#include "study/intervals.h"

#include "study/distributions.h"

namespace lockstep::host {
namespace {

constexpr double kTail = (1 - kConfidence) / 2;

}  // namespace

std::optional<std::uint64_t> values_below_median_interval(std::uint64_t count) {
  return fair_coin_quantile(count, kTail);
}

std::optional<Interval> median_interval(std::span<const double> sorted) {
  const auto below = values_below_median_interval(sorted.size());
  if (!below) return std::nullopt;
  return Interval{sorted[*below], sorted[sorted.size() - 1 - *below]};
}

Interval share_interval(std::uint64_t count, std::uint64_t all) {
  return {least_share(count, all, kTail), largest_share(count, all, kTail)};
}

}  // namespace lockstep::host
