// The numbers of a box plot.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "study/exact_sum.h"
#include "study/intervals.h"
#include "study/quantile_sketch.h"

namespace lockstep::host {

struct SampleSummary {
  std::uint64_t count = 0;
  double min = 0, q1 = 0, median = 0, q3 = 0, max = 0, mean = 0;
  std::optional<Interval> median_interval = {};
};

// The quartiles are the medians of the lower and the upper half; the median belongs to neither half
// when the count is odd. One value is its own quartiles; no values give zeros.
SampleSummary summarize(std::vector<double> values);
// The same of values that are not kept: q1, median and q3 as near as the sketch says, all else
// exact, but that the interval may be wider by as much.
SampleSummary summarize(const QuantileSketch& values, const ExactSum& sum);

}  // namespace lockstep::host
