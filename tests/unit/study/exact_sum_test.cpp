#include "study/exact_sum.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "base/core/random.h"

namespace lockstep::host {
namespace {

ExactSum sum_of(const std::vector<double>& values) {
  ExactSum sum;
  for (const double value : values) sum.add(value);
  return sum;
}

constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();

// Of all sizes and both signs.
std::vector<double> numbers(std::size_t count) {
  RandomStream random(7, 0);
  std::vector<double> all;
  while (all.size() < count) {
    const double value = std::bit_cast<double>(random.next());
    if (std::isfinite(value)) all.push_back(value);
  }
  return all;
}

}  // namespace

TEST_CASE("a sum loses nothing, whatever the sizes of its numbers") {
  CHECK(sum_of({}).mean(1) == 0);
  CHECK(sum_of({1e300, 1, -1e300}).mean(1) == 1);
  CHECK(sum_of({kLargest, kLargest, kLeast}).mean(2) == kLargest);
  CHECK(sum_of({kLargest, kLeast, -kLargest}).mean(1) == kLeast);
  CHECK(sum_of({-kLargest, -kLargest}).mean(2) == -kLargest);
  CHECK(sum_of({1, -2}).mean(1) == -1);
  CHECK(sum_of(std::vector<double>(10, 0.1)).mean(10) == 0.1);
  // Halfway between two doubles, and a little more.
  CHECK(sum_of({1, 0x1p-53}).mean(1) == 1);
  CHECK(sum_of({1, 0x1p-53, kLeast}).mean(1) == 1 + 0x1p-52);
}

TEST_CASE("a sum depends neither on the order of its numbers nor on how they were split") {
  auto all = numbers(1000);
  const std::string text = sum_of(all).text();
  ExactSum parts = sum_of({all.begin(), all.begin() + 300});
  parts.add(sum_of({all.begin() + 300, all.end()}));
  CHECK(parts.text() == text);
  std::ranges::sort(all);
  CHECK(sum_of(all).text() == text);
  for (const double value : std::vector(all)) all.push_back(-value);
  CHECK(sum_of(all).text() == "0");
}

TEST_CASE("a sum has one text, and is read from no other") {
  CHECK(sum_of({1, 2}).text() == "c0000p-18");
  for (const auto& values : {numbers(1), numbers(50), {-3.0}, {kLeast}, {kLargest, kLargest}}) {
    const std::string text = sum_of(values).text();
    const auto again = ExactSum::from(text);
    REQUIRE(again);
    CHECK(again->text() == text);
  }
  for (const char* text :
       {"", "-", "p", "-0", "00", "3p0", "c0000p-17", "C0000p-18", "0c0000p-18", "c0000p-18 ",
        "c0000", "c0000p", "c0000p-18p-18", "1p99999999999", "1p-1074x"}) {
    INFO(text);
    CHECK_FALSE(ExactSum::from(text));
  }
}

}  // namespace lockstep::host
