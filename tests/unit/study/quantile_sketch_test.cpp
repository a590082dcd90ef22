#include "study/quantile_sketch.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/core/random.h"
#include "study/sample_summary.h"

namespace lockstep::host {
namespace {

using Values = std::vector<double>;

SampleSummary sketched(const Values& values) {
  QuantileSketch sketch;
  ExactSum sum;
  for (const double value : values) {
    sketch.add(value);
    sum.add(value);
  }
  return summarize(sketch, sum);
}

double uniform(RandomStream& random) {
  return static_cast<double>(random.next() >> 11u) * 0x1p-53;
}

struct Law {
  const char* name;
  double (*draw)(RandomStream&);
};
constexpr Law kLaws[] = {
    {"uniform", uniform},
    {"around 0", [](RandomStream& random) { return uniform(random) - 0.5; }},
    {"over many sizes", [](RandomStream& random) { return std::exp2(60 * uniform(random) - 30); }},
    {"heavy tail", [](RandomStream& random) { return 1 / (1 - uniform(random)); }},
    {"negative", [](RandomStream& random) { return -1 - 1000 * uniform(random); }},
};

void check_near(double sketched, double exact) {
  CHECK(std::abs(sketched - exact) <= std::abs(exact) / 2048);
}

bool is_same(const QuantileSketch& one, const QuantileSketch& other) {
  const auto a = one.buckets(), b = other.buckets();
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return x.low == y.low && x.high == y.high && x.count == y.count;
  });
}

}  // namespace

TEST_CASE("a sketch has quantiles to one part in 2048, and all else exactly") {
  for (const Law& law : kLaws) {
    for (const std::size_t count : {1u, 2u, 3u, 6u, 101u, 20'000u}) {
      INFO(law.name << ", " << count);
      RandomStream random(11, count);
      Values values(count);
      for (double& value : values) value = law.draw(random);
      const SampleSummary exact = summarize(values), it = sketched(values);
      CHECK(it.count == exact.count);
      CHECK(it.min == exact.min);
      CHECK(it.max == exact.max);
      CHECK(it.mean == exact.mean);
      // Of an even number, the middle of two numbers: near 0 these may have other signs.
      if (count % 2 == 1) check_near(it.median, exact.median);
      if (count % 4 == 3) check_near(it.q1, exact.q1);
      if (count % 4 == 3) check_near(it.q3, exact.q3);
      REQUIRE(it.median_interval.has_value() == exact.median_interval.has_value());
      if (!it.median_interval) continue;
      CHECK(it.median_interval->low <= exact.median_interval->low);
      CHECK(it.median_interval->high >= exact.median_interval->high);
      CHECK(std::abs(it.median_interval->low - exact.median_interval->low) <=
            std::abs(exact.median_interval->low) / 1024);
    }
  }
}

TEST_CASE("a sketch is exact for whole numbers below 2048, and for what has few values") {
  Values values;
  for (int i = 0; i < 5000; ++i) values.push_back((i * 7919) % 2048);
  for (const Values& all : {values, Values{0.1, 0.1, 0.1, 0.7, 0.7, 1.5}, Values{-0.0, 0.0}}) {
    const SampleSummary exact = summarize(all), it = sketched(all);
    CHECK(it.q1 == exact.q1);
    CHECK(it.median == exact.median);
    CHECK(it.q3 == exact.q3);
  }
}

TEST_CASE("a sketch depends neither on order nor on how the numbers were split") {
  RandomStream random(3, 0);
  QuantileSketch all, backwards, first, second;
  Values values;
  for (int i = 0; i < 3000; ++i) {
    const double value = uniform(random) - 0.5;
    values.push_back(value);
    all.add(value);
    (i % 3 == 0 ? first : second).add(value);
  }
  for (auto value = values.rbegin(); value != values.rend(); ++value) backwards.add(*value);
  second.add(first);
  CHECK(is_same(all, backwards));
  CHECK(is_same(all, second));
}

TEST_CASE("what no bucket has is refused") {
  QuantileSketch sketch;
  CHECK(sketch.add(QuantileSketch::Bucket{1, 1, 1}));
  CHECK(sketch.add(QuantileSketch::Bucket{1, 1.0001, 2}));
  CHECK_FALSE(sketch.add(QuantileSketch::Bucket{1, 1.001, 2}));
  CHECK_FALSE(sketch.add(QuantileSketch::Bucket{1.0001, 1, 2}));
  CHECK_FALSE(sketch.add(QuantileSketch::Bucket{1, 1.0001, 1}));
  CHECK_FALSE(sketch.add(QuantileSketch::Bucket{1, 1, 0}));
  CHECK(sketch.count() == 3);
}

}  // namespace lockstep::host
