#include "study/sample_summary.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace lockstep::host {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median_of(std::span<const double> sorted) {
  const std::size_t half = sorted.size() / 2;
  if (sorted.size() % 2 == 1) return sorted[half];
  return sorted[half - 1] + (sorted[half] - sorted[half - 1]) / 2;
}

}  // namespace

SampleSummary summarize(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::span<const double> sorted = values;
  const std::size_t half = std::max<std::size_t>(sorted.size() / 2, 1);
  return {.count = sorted.size(),
          .min = sorted.front(),
          .q1 = median_of(sorted.first(half)),
          .median = median_of(sorted),
          .q3 = median_of(sorted.last(half)),
          .max = sorted.back(),
          .mean = mean_of(sorted),
          .median_interval = lockstep::host::median_interval(sorted)};
}

}  // namespace lockstep::host
