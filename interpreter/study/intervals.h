// 95 % confidence intervals of what a cell of a study estimates.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace lockstep::host {

struct Interval {
  double low = 0, high = 0;
};

constexpr double kConfidence = 0.95;

// The interval of the median, between two values of the sample, whatever the distribution: a value
// is below the median as often as a coin shows heads, so how many are is binomial. With at least 95
// %; five values and fewer have none.
std::optional<Interval> median_interval(std::span<const double> sorted);
// How many of so many values are below that interval, and how many above it.
std::optional<std::uint64_t> values_below_median_interval(std::uint64_t count);

// The interval of the probability of what `count` of `all` runs were: Clopper and Pearson (1934).
// With at least 95 % too, for every probability and number of runs. `all` is at least 1.
Interval share_interval(std::uint64_t count, std::uint64_t all);

}  // namespace lockstep::host
