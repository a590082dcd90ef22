// The numbers of a box plot.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "study/intervals.h"

namespace lockstep::host {

struct SampleSummary {
  std::size_t count = 0;
  double min = 0, q1 = 0, median = 0, q3 = 0, max = 0, mean = 0;
  std::optional<Interval> median_interval = {};
};

// The quartiles are the medians of the lower and the upper half; the median belongs to neither half
// when the count is odd. One value is its own quartiles; no values give zeros.
SampleSummary summarize(std::vector<double> values);

}  // namespace lockstep::host
