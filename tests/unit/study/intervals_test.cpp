// The intervals against published values, and how often they contain what they estimate.
#include "study/intervals.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/random.h"
#include "study/distributions.h"

namespace lockstep {
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

// Of a probability that is another one in each repeat.
double share_coverage(std::uint64_t runs, std::uint64_t seed) {
  RandomStream random(seed, 1);
  int contained = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const double probability = random.next_double();
    std::uint64_t count = 0;
    for (std::uint64_t run = 0; run < runs; ++run) {
      count += random.next_double() < probability ? 1u : 0u;
    }
    const Interval it = share_interval(count, runs);
    contained += it.low <= probability && probability <= it.high ? 1 : 0;
  }
  return contained / double{kRepeats};
}

// Three standard deviations of a share of so many repeats.
double scatter(double probability) {
  return 3 * std::sqrt(probability * (1 - probability) / kRepeats);
}

}  // namespace

TEST_CASE("intervals: the normal distribution is as its tables say") {
  CHECK(normal_quantile(0.975) == Approx(1.959963984540054));
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

TEST_CASE("intervals: of shares, Wilson's") {
  CHECK(share_interval(5, 10).low == Approx(0.2366).margin(5e-5));
  CHECK(share_interval(5, 10).high == Approx(0.7634).margin(5e-5));
  CHECK(share_interval(0, 20).low == 0);
  CHECK(share_interval(0, 20).high == Approx(0.1611).margin(5e-5));
  CHECK(share_interval(20, 20).low == Approx(0.8389).margin(5e-5));
  CHECK(share_interval(20, 20).high == 1);
  CHECK(share_interval(81, 263).low == Approx(0.2553).margin(5e-5));  // Newcombe 1998
  CHECK(share_interval(81, 263).high == Approx(0.3662).margin(5e-5));
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

TEST_CASE("intervals: 95 of 100 of a share's contain it") {
  for (const std::uint64_t runs : {10, 30, 200}) {
    INFO("of " << runs << " runs");
    CHECK(share_coverage(runs, 2019) == Approx(kConfidence).margin(scatter(kConfidence)));
  }
}

}  // namespace lockstep
