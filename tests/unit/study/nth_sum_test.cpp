// The order statistics of sums, against a list of all sums.
#include "study/nth_sum.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/core/random.h"

namespace lockstep::host {
namespace {

using Values = std::vector<double>;

// Ascending. Few different values if `steps` is small, so that many sums are equal.
Values sample(RandomStream& random, std::size_t count, double steps) {
  Values values(count);
  for (double& value : values) value = std::floor(steps * (random.next_double() - 0.5)) / 7;
  std::ranges::sort(values);
  return values;
}

void check_all(const Values& x, const Values& y) {
  Values sums;
  for (const double a : x) {
    for (const double b : y) sums.push_back(a + b);
  }
  std::ranges::sort(sums);
  for (std::size_t n = 0; n < sums.size(); ++n) CHECK(nth_sum(x, y, n) == sums[n]);
}

void check_own(const Values& x) {
  Values sums;
  for (std::size_t j = 0; j < x.size(); ++j) {
    for (std::size_t i = 0; i <= j; ++i) sums.push_back(x[i] + x[j]);
  }
  std::ranges::sort(sums);
  for (std::size_t n = 0; n < sums.size(); ++n) CHECK(nth_own_sum(x, n) == sums[n]);
}

}  // namespace

TEST_CASE("nth sum: each is the one of a sorted list, bit for bit") {
  RandomStream random(1963, 0);
  for (const double steps : {2.0, 9.0, 1e15}) {
    for (const std::size_t count : {1, 2, 5, 12}) {
      const Values x = sample(random, count, steps), y = sample(random, 7, steps);
      check_all(x, y);
      check_own(x);
    }
  }
}

TEST_CASE("nth sum: of both signs, of zeros, of the smallest and the largest doubles") {
  const Values x{-1e308, -1, -5e-324, -0.0, 0.0, 5e-324, 0.1, 1e17};
  check_all(x, Values{-0.2, 0.0, 1e-300, 3});
  check_own(x);
  CHECK_FALSE(std::signbit(nth_sum(Values{-0.0}, Values{-0.0}, 0)));
}

TEST_CASE("nth sum: of 10^10 sums without a list of them") {
  Values x(100'000);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i);
  CHECK(nth_sum(x, x, 0) == 0);
  CHECK(nth_sum(x, x, 5'000'000'000) == 99'999);  // x + y = s has s + 1 pairs up to here
  CHECK(nth_sum(x, x, 10'000'000'000 - 1) == 199'998);
  CHECK(nth_own_sum(x, 5'000'050'000 - 1) == 199'998);
}

}  // namespace lockstep::host
