#include "base/core/histogram.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/core/random.h"

namespace lockstep::host {
namespace {

Nanoseconds exact_quantile(std::vector<Nanoseconds> values, double fraction) {
  std::sort(values.begin(), values.end());
  const auto rank = std::ceil(fraction * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

void check_quantiles(const std::vector<Nanoseconds>& values, unsigned bits, double error) {
  Histogram histogram(bits);
  for (const Nanoseconds value : values) histogram.record(value);
  for (const double fraction : {0.0, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto exact = static_cast<double>(exact_quantile(values, fraction).count());
    const auto found = static_cast<double>(histogram.quantile(fraction).count());
    INFO("fraction " << fraction << ", exact " << exact);
    CHECK(found >= exact);
    CHECK(found <= (1 + error) * exact);
  }
  CHECK(histogram.max() == *std::max_element(values.begin(), values.end()));
  CHECK(histogram.count() == values.size());
}

TEST_CASE("quantiles of the histogram are exact or too large by less than a bucket's width") {
  RandomStream random(7, 1);
  std::vector<Nanoseconds> even, wide;
  for (int i = 0; i < 20000; ++i) {
    even.push_back(from_seconds(0.009 + 0.002 * random.next_double()));
    wide.push_back(Nanoseconds(std::int64_t(std::exp(43 * random.next_double()))));
  }
  for (const auto* values : {&even, &wide}) {
    check_quantiles(*values, Histogram::kFine, 0.001);
    check_quantiles(*values, Histogram::kCoarse, 1.0 / 16);
  }
}

TEST_CASE("the histogram is exact below 1024 ns and takes every duration") {
  Histogram histogram;
  CHECK(histogram.quantile(0.5) == Nanoseconds(0));
  histogram.record(Nanoseconds(1023));
  CHECK(histogram.quantile(0.5) == Nanoseconds(1023));
  histogram.record(Nanoseconds(-5));
  CHECK(histogram.quantile(0) == Nanoseconds(0));
  histogram.record(Nanoseconds::max());
  CHECK(histogram.max() == Nanoseconds::max());
  CHECK(histogram.quantile(1) > Nanoseconds::max() - Nanoseconds::max() / 100);
}

TEST_CASE("the histogram counts durations by their binary digits") {
  for (const unsigned bits : {Histogram::kCoarse, Histogram::kFine}) {
    Histogram histogram(bits);
    CHECK(histogram.by_digits().empty());
    for (const int value : {0, 1, 2, 3, 4, 1023, 1024, 1025, 2047, 2048}) {
      histogram.record(Nanoseconds(value));
    }
    CHECK(histogram.by_digits() ==
          std::vector<std::uint64_t>{1, 1, 2, 1, 0, 0, 0, 0, 0, 0, 1, 3, 1});
  }
}

}  // namespace
}  // namespace lockstep::host
