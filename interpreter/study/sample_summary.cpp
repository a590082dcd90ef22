#include "study/sample_summary.h"

#include <algorithm>

namespace lockstep::host {
namespace {

using Ranked = QuantileSketch::Bucket;

// The middle between two numbers, without an overflow.
double middle(double low, double high) {
  return low + (high - low) / 2;
}

// The median of `count` values from the rank `first` on; `at` gives the value of a rank.
template <class At>
double median_of(const At& at, std::uint64_t first, std::uint64_t count) {
  const std::uint64_t half = first + count / 2;
  return count % 2 == 1 ? at(half) : middle(at(half - 1), at(half));
}

template <class At>
void find_quartiles(const At& at, SampleSummary& summary) {
  const std::uint64_t count = summary.count, half = std::max<std::uint64_t>(count / 2, 1);
  summary.q1 = median_of(at, 0, half);
  summary.median = median_of(at, 0, count);
  summary.q3 = median_of(at, count - half, half);
}

}  // namespace

SampleSummary summarize(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  ExactSum sum;
  for (const double value : values) sum.add(value);
  SampleSummary summary{.count = values.size(), .min = values.front(), .max = values.back()};
  summary.mean = sum.mean(summary.count);
  find_quartiles([&](std::uint64_t rank) { return values[rank]; }, summary);
  summary.median_interval = median_interval(values);
  return summary;
}

SampleSummary summarize(const QuantileSketch& values, const ExactSum& sum) {
  if (values.count() == 0) return {};
  // The counts become the numbers of values up to the end of each bucket.
  std::vector<Ranked> ranked = values.buckets();
  for (std::size_t i = 1; i < ranked.size(); ++i) ranked[i].count += ranked[i - 1].count;
  const auto bucket = [&](std::uint64_t rank) -> const Ranked& {
    return *std::ranges::upper_bound(ranked, rank, {}, &Ranked::count);
  };
  SampleSummary summary{
      .count = values.count(), .min = ranked.front().low, .max = ranked.back().high};
  summary.mean = sum.mean(summary.count);
  find_quartiles([&](std::uint64_t rank) { return middle(bucket(rank).low, bucket(rank).high); },
                 summary);
  if (const auto below = values_below_median_interval(summary.count)) {
    summary.median_interval = {bucket(*below).low, bucket(summary.count - 1 - *below).high};
  }
  return summary;
}

}  // namespace lockstep::host
