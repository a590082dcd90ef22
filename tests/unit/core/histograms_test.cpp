// Many histograms at once: each keeps to itself, and its quantiles are as exact as is said.
#include "base/core/histograms.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

namespace lockstep::host::test {

TEST_CASE("a quantile is never too small and at most a sixteenth too large") {
  std::mt19937_64 random(7);
  Histograms all(3);
  std::vector<std::uint64_t> values;
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t value = random() >> (24 + random() % 40);
    values.push_back(value);
    all.record(1, value);
    all.record(2, 5);
  }
  std::ranges::sort(values);
  for (const double fraction : {0.0, 0.01, 0.5, 0.9, 0.99, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * 20'000));
    const std::uint64_t exact = values[std::max<std::size_t>(rank, 1) - 1];
    const std::uint64_t found = all.quantile(1, fraction);
    INFO(fraction << ": " << exact);
    CHECK((found >= exact && found <= exact + exact / 16 + 1));
  }
  CHECK(all.count(0) == 0);
  CHECK(all.quantile(0, 0.5) == 0);
  CHECK(all.count(1) == 20'000);
  CHECK(all.quantile(2, 0.5) == 5);
}

TEST_CASE("what is larger than all sizes counts as the largest") {
  Histograms one(1);
  one.record(0, ~std::uint64_t{0});
  CHECK(one.quantile(0, 1) == (std::uint64_t{1} << 40) - 1);
}

}  // namespace lockstep::host::test
