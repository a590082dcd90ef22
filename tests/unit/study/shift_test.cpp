// The shifts against published values, against the tests that they invert, and how often they
// contain the true one: as an exact sum.
#include "study/shift.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/core/random.h"
#include "study/rank_tests.h"

namespace lockstep::host {
namespace {

using Values = std::vector<double>;

Values shifted(Values values, double by) {
  for (double& value : values) value += by;
  return values;
}

Values shifted_sample(RandomStream& random, std::size_t count, double by) {
  Values values(count);
  for (double& value : values) value = by - std::log1p(-random.next_double());
  return values;
}

// A few steps only, so that values are equal within a sample and between two.
Values steps(RandomStream& random, std::size_t count, double levels, double by) {
  Values values(count);
  for (double& value : values) value = std::floor(levels * random.next_double() + by);
  return values;
}

bool contains(const std::optional<Interval>& interval, double value) {
  return !interval || (interval->low <= value && value <= interval->high);
}

// How likely each value of a statistic is that has `ways`, if all are as likely.
Values likelihoods(const Values& ways) {
  Values result = ways;
  const double all = std::accumulate(ways.begin(), ways.end(), 0.0);
  for (double& it : result) it /= all;
  return result;
}

// Of how many pairs the second is larger, of samples of one continuous distribution: the
// coefficients of the Gaussian binomial (Mann, Whitney 1947).
Values larger_pairs(std::size_t m, std::size_t n) {
  Values ways(m * n + 1, 0.0);
  ways[0] = 1;
  for (std::size_t i = 1; i <= m; ++i) {
    for (std::size_t k = m * n; k >= n + i; --k) ways[k] -= ways[k - n - i];
    for (std::size_t k = i; k <= m * n; ++k) ways[k] += ways[k - i];
  }
  return likelihoods(ways);
}

// How many Walsh averages are above 0: each rank is positive or not (Wilcoxon 1945).
Values positive_ranks(std::size_t n) {
  Values ways(n * (n + 1) / 2 + 1, 0.0);
  ways[0] = 1;
  for (std::size_t rank = 1; rank <= n; ++rank) {
    for (std::size_t k = ways.size() - 1; k >= rank; --k) ways[k] += ways[k - rank];
  }
  return likelihoods(ways);
}

// The interval of numbers 0 to all - 1 leaves out as many below as above. It contains the true
// shift if neither fewer numbers than those, and one, are above it, nor fewer below it.
double coverage(const std::optional<Interval>& interval, double first, const Values& likelihood) {
  if (!interval) return 1;
  const auto outside = static_cast<std::size_t>(interval->low - first) + 1;
  return std::accumulate(likelihood.begin() + static_cast<std::ptrdiff_t>(outside),
                         likelihood.end() - static_cast<std::ptrdiff_t>(outside), 0.0);
}

}  // namespace

TEST_CASE("shifts: of two samples as published") {
  // Permeability of membranes at term and after 12 to 26 weeks (Hollander, Wolfe 1973): -0.305, and
  // from -0.76 to 0.15.
  const Values term{0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
  const Values before{1.15, 0.88, 0.90, 0.74, 1.21};
  const Shift shift = shift_between(term, before);
  CHECK(shift.estimate == Approx(-0.305));
  REQUIRE(shift.interval);
  CHECK(shift.interval->low == Approx(-0.76));
  CHECK(shift.interval->high == Approx(0.15));
}

TEST_CASE("shifts: of pairs as published") {
  // Depression before and after a first visit (Hollander, Wolfe 1973): -0.46, and from -0.786 to
  // -0.010.
  const Values before{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const Values after{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  Values differences;
  for (std::size_t i = 0; i < before.size(); ++i) differences.push_back(after[i] - before[i]);
  const Shift shift = shift_of(differences);
  CHECK(shift.estimate == Approx(-0.46));
  REQUIRE(shift.interval);
  CHECK(shift.interval->low == Approx(-0.786));
  CHECK(shift.interval->high == Approx(-0.010));
}

TEST_CASE("shifts: without equal values, 0 is in the interval exactly if p is at least 0.05") {
  RandomStream random(1963, 0);
  int rejected = 0;
  for (int repeat = 0; repeat < 400; ++repeat) {
    const std::size_t m = 3 + static_cast<std::size_t>(repeat % 17);
    const Values first = shifted_sample(random, m, 0), second = shifted_sample(random, 12, 0.5);
    const double p = mann_whitney(first, second).p;
    CHECK(contains(shift_between(first, second).interval, 0) == (p >= 0.05));
    Values differences = shifted_sample(random, m, -0.3);
    const double paired = signed_rank(differences).p;
    CHECK(contains(shift_of(differences).interval, 0) == (paired >= 0.05));
    rejected += (p < 0.05 ? 1 : 0) + (paired < 0.05 ? 1 : 0);
  }
  CHECK(rejected > 50);
  CHECK(rejected < 750);
}

TEST_CASE("shifts: a shift of which p is at least 0.05 is in the interval, with equal values too") {
  RandomStream random(1963, 1);
  int at_end = 0;
  for (int repeat = 0; repeat < 600; ++repeat) {
    const double levels = 1.3 + repeat % 4;
    const Values first = steps(random, 20, levels, 0), second = steps(random, 37, levels, 0.4);
    const Values differences = steps(random, 15, levels, -1.7);
    const auto between = shift_between(first, second).interval;
    const auto of_pairs = shift_of(differences).interval;
    for (double by = -6; by <= 6; by += 0.25) {
      const double p = mann_whitney(first, shifted(second, -by)).p;
      if (p >= 0.05) CHECK(contains(between, by));
      const double paired = signed_rank(shifted(differences, -by)).p;
      if (paired >= 0.05) CHECK(contains(of_pairs, by));
      // Between the steps nothing is equal.
      if (std::fmod(std::abs(by), 0.5) == 0) continue;
      CHECK(contains(between, by) == (p >= 0.05));
      CHECK(contains(of_pairs, by) == (paired >= 0.05));
    }
    at_end += mann_whitney(first, second).p < 0.05 && contains(between, 0) ? 1 : 0;
  }
  CHECK(at_end > 0);  // as shift.h says
}

TEST_CASE("shifts: of few pairs, the interval has exactly the shifts that the exact test accepts") {
  RandomStream random(1963, 3);
  for (int repeat = 0; repeat < 60; ++repeat) {
    Values differences = steps(random, 6 + static_cast<std::size_t>(repeat) % 9, 2 + repeat % 5, 0);
    for (double& value : differences) value *= 0.1;  // sums that round
    const auto interval = shift_of(differences).interval;
    REQUIRE(interval);
    for (double by = -0.5125; by < 1; by += 0.05) {  // between all means of two
      CHECK(contains(interval, by) == (signed_rank(shifted(differences, -by)).p >= 0.05));
    }
  }
}

TEST_CASE("shifts: many zeros are no reason to leave 0 out") {
  // 78 differences up, the smaller ones, 22 down and 56 zeros: without the zeros' ranks, p would be
  // 0.05 and more while the interval is above 0.
  Values differences(56, 0.0);
  for (int size = 1; size <= 100; ++size) differences.push_back(size <= 78 ? size : -size);
  const double p = signed_rank(differences).p;
  CHECK(contains(shift_of(differences).interval, 0) == (p >= 0.05));
}

TEST_CASE("shifts: turned samples have turned shifts") {
  RandomStream random(1963, 2);
  const Values first = shifted_sample(random, 20, 0), second = shifted_sample(random, 31, 0.2);
  const Shift shift = shift_between(first, second), turned = shift_between(second, first);
  CHECK(turned.estimate == -shift.estimate);
  CHECK(turned.interval->low == -shift.interval->high);
  CHECK(turned.interval->high == -shift.interval->low);
}

TEST_CASE("shifts: the interval of pairs contains the estimate, also where most pairs are equal") {
  RandomStream random(1963, 4);
  int rejected = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    Values differences(30 + static_cast<std::size_t>(repeat) % 11, 0.0), turned;
    const auto others = static_cast<std::size_t>(repeat % 9);  // all of them above
    for (std::size_t i = 0; i < others; ++i)
      differences[i] = std::floor(1 + 1.4 * random.next_double());
    for (const double value : differences) turned.push_back(-value);
    const Shift shift = shift_of(differences), other = shift_of(turned);
    INFO(repeat);
    REQUIRE(shift.interval);
    CHECK(contains(shift.interval, shift.estimate));
    CHECK(other.estimate == -shift.estimate);
    CHECK(other.interval->low == -shift.interval->high);
    CHECK(other.interval->high == -shift.interval->low);
    rejected += signed_rank(differences).p < 0.05 ? 1 : 0;
  }
  CHECK(rejected > 0);
  // 33 of 39 are equal: each shift is rejected.
  Values differences(39, 0.0);
  std::fill_n(differences.begin(), 6, 1.0);
  const Shift alone = shift_of(differences);
  CHECK(alone.estimate == 0);
  CHECK(alone.interval->low == 0);
  CHECK(alone.interval->high == 0);
}

TEST_CASE("shifts: few values have no interval, equal ones an interval of one point") {
  CHECK(shift_between(Values{1}, Values{3}).estimate == 2);
  CHECK_FALSE(shift_between(Values{1}, Values{3}).interval);
  CHECK_FALSE(shift_between(Values{1, 2, 3}, Values{7, 8, 9}).interval);
  CHECK(shift_between(Values{1, 2, 3, 4}, Values{7, 8, 9, 10}).interval);
  CHECK_FALSE(shift_of(Values{1, 2, 3, 4, 5}).interval);
  CHECK(shift_of(Values{1, 2, 3, 4, 5, 6}).interval);
  const Values twos(20, 2.0);
  const Shift none = shift_between(twos, twos);
  CHECK(none.estimate == 0);
  CHECK(none.interval->low == 0);
  CHECK(none.interval->high == 0);
  CHECK(shift_of(twos).estimate == 2);
  CHECK(shift_of(twos).interval->low == 2);
}

// docs/studies.md: at least 95 of 100, whatever the number of runs.
TEST_CASE("shifts: at least 95 of 100 intervals of two samples contain the true shift") {
  for (std::size_t m = 1; m <= 24; ++m) {
    for (std::size_t n = m; n <= 24; ++n) {
      Values first(m), second(n);  // their differences are 1 to m * n
      for (std::size_t i = 0; i < m; ++i) first[i] = -static_cast<double>(i);
      for (std::size_t j = 0; j < n; ++j) second[j] = static_cast<double>(1 + j * m);
      INFO(m << " and " << n);
      const double share = coverage(shift_between(first, second).interval, 1, larger_pairs(m, n));
      CHECK(share >= kConfidence);
      if (m >= 12) CHECK(share < 0.965);
    }
  }
}

TEST_CASE("shifts: at least 95 of 100 intervals of pairs contain the true shift") {
  for (std::size_t n = 1; n <= 60; ++n) {
    // Powers of two: sums of different pairs differ. Which number the ends are is counted below.
    Values differences(n);
    for (std::size_t i = 0; i < n; ++i) differences[i] = std::ldexp(1.0, static_cast<int>(i));
    Values averages;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i <= j; ++i)
        averages.push_back((differences[i] + differences[j]) / 2);
    }
    std::ranges::sort(averages);
    auto interval = shift_of(differences).interval;
    if (interval) {
      const auto below = std::ranges::lower_bound(averages, interval->low) - averages.begin();
      interval->low = static_cast<double>(below);
    }
    INFO(n);
    const double share = coverage(interval, 0, positive_ranks(n));
    CHECK(share >= kConfidence);
    if (n >= 20) CHECK(share < 0.965);
  }
}

TEST_CASE("shifts: of 20,000 runs with 20,000, without a list of their differences") {
  Values first(20'000);
  std::iota(first.begin(), first.end(), 0.0);
  const Shift shift = shift_between(first, shifted(first, 50));
  CHECK(shift.estimate == 50);
  // 1.96 standard deviations of a mean of so many, for values that are uniform.
  const double width = 1.96 * std::sqrt(2.0 / 12) * 20'000 / std::sqrt(20'000.0);
  CHECK(shift.interval->low == Approx(50 - width).epsilon(0.02));
  CHECK(shift.interval->high == Approx(50 + width).epsilon(0.02));
}

}  // namespace lockstep::host
