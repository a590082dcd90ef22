#include "study/intervals.h"

#include "study/distributions.h"

namespace lockstep::host {
namespace {

constexpr double kTail = (1 - kConfidence) / 2;

}  // namespace

std::optional<Interval> median_interval(std::span<const double> sorted) {
  const auto below = fair_coin_quantile(sorted.size(), kTail);
  if (!below) return std::nullopt;
  return Interval{sorted[*below], sorted[sorted.size() - 1 - *below]};
}

Interval share_interval(std::uint64_t count, std::uint64_t all) {
  return {least_share(count, all, kTail), largest_share(count, all, kTail)};
}

}  // namespace lockstep::host
