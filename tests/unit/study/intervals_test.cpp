// The intervals against published values, and how often they contain what they estimate: of shares
// as an exact sum, of medians by trying.
#include "study/intervals.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/core/random.h"
#include "study/distributions.h"

namespace lockstep::host {
namespace {

constexpr int kRepeats = 1000;

// 0, 1, 2 …: an interval of it is made of places.
Interval places(std::size_t count) {
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), 0.0);
  return median_interval(values).value();
}

// The share of repeats in which the interval of a sample contains the median. The distribution is
// far from symmetric: exponential.
double median_coverage(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed, 0);
  int contained = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    std::vector<double> values(count);
    for (double& value : values) value = -std::log1p(-random.next_double());
    std::sort(values.begin(), values.end());
    const Interval it = median_interval(values).value();
    contained += it.low <= std::log(2.0) && std::log(2.0) <= it.high ? 1 : 0;
  }
  return contained / double{kRepeats};
}

// How likely it is that the interval of a share contains its probability: the sum of the binomial
// probabilities of the counts whose interval does.
double share_coverage(const std::vector<Interval>& of_count, double probability) {
  const auto n = static_cast<double>(of_count.size() - 1);
  double coverage = 0;
  for (std::size_t count = 0; count < of_count.size(); ++count) {
    if (probability < of_count[count].low || of_count[count].high < probability) continue;
    const auto k = static_cast<double>(count);
    coverage += std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) +
                         k * std::log(probability) + (n - k) * std::log1p(-probability));
  }
  return coverage;
}

// The least and the largest coverage of the probabilities from first to last, in steps of 0.001.
Interval coverages(const std::vector<Interval>& of_count, double first, double last) {
  Interval found{1, 0};
  for (int step = 1; step < 1000; ++step) {
    const double probability = step / 1000.0;
    if (probability < first || probability > last) continue;
    const double coverage = share_coverage(of_count, probability);
    found = {std::min(found.low, coverage), std::max(found.high, coverage)};
  }
  return found;
}

Interval wilson(std::uint64_t count, std::uint64_t all) {
  const double z = 1.959963984540054, n = static_cast<double>(all);
  const double share = static_cast<double>(count) / n, weight = 1 + z * z / n;
  const double middle = (share + z * z / (2 * n)) / weight;
  const double half = z / weight * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
  return {middle - half, middle + half};
}

// Of each count from 0 on.
std::vector<Interval> share_intervals(std::uint64_t runs,
                                      Interval interval(std::uint64_t, std::uint64_t)) {
  std::vector<Interval> of_count;
  for (std::uint64_t count = 0; count <= runs; ++count) of_count.push_back(interval(count, runs));
  return of_count;
}

// Three standard deviations of a share of so many repeats.
double scatter(double probability) {
  return 3 * std::sqrt(probability * (1 - probability) / kRepeats);
}

}  // namespace

TEST_CASE("intervals: the normal distribution is as its tables say") {
  CHECK(normal_two_sided(1.959963984540054) == Approx(0.05));
  CHECK(normal_two_sided(-2.5758293) == Approx(0.01));
}

TEST_CASE("intervals: the median's is between the ranks of the sign test") {
  // The tables count from 1: 1 and 6 of 6, 2 and 9 of 10, 6 and 15 of 20, 40 and 61 of 100.
  CHECK_FALSE(median_interval(std::vector<double>{1, 2, 3, 4, 5}).has_value());
  CHECK_FALSE(median_interval({}).has_value());
  CHECK(places(6).low == 0);
  CHECK(places(6).high == 5);
  CHECK(places(10).low == 1);
  CHECK(places(10).high == 8);
  CHECK(places(20).low == 5);
  CHECK(places(20).high == 14);
  CHECK(places(100).low == 39);
  CHECK(places(100).high == 60);
  // In a large sample, 1.96 standard deviations of sqrt(n) / 2 from the middle.
  CHECK(places(1'000'000).low == Approx(500'000 - 980).margin(2));
}

TEST_CASE("intervals: of shares, those of Clopper and Pearson as published") {
  const auto check = [](std::uint64_t count, std::uint64_t all, double low, double high) {
    INFO(count << " of " << all);
    CHECK(share_interval(count, all).low == Approx(low).margin(5e-5));
    CHECK(share_interval(count, all).high == Approx(high).margin(5e-5));
  };
  check(81, 263, 0.2527, 0.3676);  // these four: Newcombe 1998
  check(15, 148, 0.0578, 0.1617);
  check(0, 20, 0, 0.1684);
  check(1, 29, 0.0009, 0.1776);
  check(5, 10, 0.1871, 0.8129);
  check(20, 20, 0.8316, 1);
  // Of none, the upper end is the share with which none of 1000 is as likely as 2.5 %.
  CHECK(share_interval(0, 1000).low == 0);
  CHECK(share_interval(0, 1000).high == Approx(1 - std::pow(0.025, 0.001)));
  CHECK(share_interval(1000, 1000).low == Approx(std::pow(0.025, 0.001)));
  CHECK(share_interval(1000, 1000).high == 1);
  CHECK(share_interval(0, 1).high == Approx(0.975));
}

TEST_CASE("intervals: 95 of 100 of the median's contain it, or as many more as there are ranks") {
  for (const std::size_t count : {6, 9, 10, 25, 100, 401}) {
    INFO("of " << count << " values");
    const std::uint64_t below = fair_coin_quantile(count, 0.025).value();
    double outside = std::pow(0.5, count), coins = outside;
    for (std::uint64_t k = 1; k <= below; ++k) {
      coins *= static_cast<double>(count + 1 - k) / static_cast<double>(k);
      outside += coins;
    }
    const double exact = 1 - 2 * outside;
    CHECK(exact >= kConfidence);
    CHECK(exact < 0.985);
    CHECK(median_coverage(count, 2019) == Approx(exact).margin(scatter(exact)));
  }
}

// What docs/studies.md says of them.
TEST_CASE("intervals: at least 95 of 100 of a share's contain it, whatever it is") {
  for (const std::uint64_t runs : {1, 2, 5, 10, 30, 100, 400}) {
    const auto of_count = share_intervals(runs, share_interval);
    const auto [least, most] = coverages(of_count, 0.001, 0.999);
    const auto [least_inside, most_inside] = coverages(of_count, 0.1, 0.9);
    INFO("of " << runs << " runs: " << least << " to " << most);
    CHECK(least >= kConfidence);
    if (runs == 30) CHECK(least_inside == Approx(0.954).margin(5e-4));
    if (runs == 30) CHECK(most_inside == Approx(0.992).margin(5e-4));
    if (runs >= 100) CHECK(most_inside < 0.98);
  }
}

TEST_CASE("intervals: not as many of Wilson's do") {
  const auto of_count = share_intervals(30, wilson);
  CHECK(share_coverage(of_count, 0.3) == Approx(0.93).margin(5e-3));
  CHECK(coverages(of_count, 0.001, 0.999).low == Approx(0.86).margin(5e-3));
}

}  // namespace lockstep::host
