// The tests of ranks, against published values, against all permutations, and how often they find
// what is not there.
#include "study/rank_tests.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/core/random.h"
#include "study/ranks.h"

namespace lockstep::host {
namespace {

using Values = std::vector<double>;

// The mean of the places that a value has among all.
double mean_rank(const Values& all, double value) {
  double below = 0, equal = 0;
  for (const double other : all) {
    below += other < value ? 1 : 0;
    equal += other == value ? 1 : 0;
  }
  return below + (equal + 1) / 2;
}

// Over all choices of signs of the differences: how many give a sum of ranks as far from the
// middle.
double exact_p(const Values& differences) {
  const std::size_t count = differences.size();
  Values sizes;
  for (const double difference : differences) sizes.push_back(std::abs(difference));
  const auto sum_of = [&](auto is_positive) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (sizes[i] == 0) continue;  // it has a rank, and no sign
      const double rank = mean_rank(sizes, sizes[i]);
      sum += is_positive(i) ? rank : -rank;
    }
    return std::abs(sum);
  };
  const double found = sum_of([&](std::size_t i) { return differences[i] > 0; });
  int as_far = 0;
  for (unsigned signs = 0; signs < 1u << count; ++signs) {
    as_far += sum_of([&](std::size_t i) { return (signs >> i & 1u) != 0; }) >= found ? 1 : 0;
  }
  return as_far / std::pow(2.0, static_cast<double>(count));
}

// Over all choices of so many of all values: how many have a sum of ranks as far from the middle.
double exact_p(const Values& first, const Values& second) {
  Values all = first;
  all.insert(all.end(), second.begin(), second.end());
  const auto middle = static_cast<double>(second.size() * (all.size() + 1)) / 2;
  const auto off = [&](unsigned chosen) {
    double sum = -middle;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((chosen >> i & 1u) != 0) sum += mean_rank(all, all[i]);
    }
    return std::abs(sum);
  };
  const double found = off(((1u << second.size()) - 1u) << first.size());
  double as_far = 0, choices = 0;
  for (unsigned chosen = 0; chosen < 1u << all.size(); ++chosen) {
    if (std::popcount(chosen) != static_cast<int>(second.size())) continue;
    ++choices;
    as_far += off(chosen) >= found - 1e-9 ? 1 : 0;
  }
  return as_far / choices;
}

}  // namespace

TEST_CASE("rank tests: Mann-Whitney as published, with ties") {
  // Ozone in New York in May and in August 1973 (R, airquality): W = 127.5, p = 0.0001208.
  const Values may{41, 36, 12, 18, 28, 23, 19, 8, 7,  16, 11, 14,  18,
                   14, 34, 6,  30, 11, 1,  11, 4, 32, 23, 45, 115, 37};
  const Values august{39, 9,  16, 78, 35, 66, 122, 89,  110, 44, 28,  65, 22,
                      59, 23, 31, 44, 21, 9,  45,  168, 73,  76, 118, 84, 85};
  const RankTest test = mann_whitney(may, august);
  CHECK(test.p == Approx(0.0001208).epsilon(1e-3));
  CHECK(test.effect == Approx(1 - 2 * 127.5 / (26 * 26)));
  const RankTest turned = mann_whitney(august, may);
  CHECK(turned.p == Approx(test.p));
  CHECK(turned.effect == Approx(-test.effect));
}

TEST_CASE("rank tests: signed ranks as published") {
  // Depression before and after a first visit (Hollander, Wolfe 1973): V = 40 of nine patients.
  const Values before{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const Values after{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  Values differences;
  for (std::size_t i = 0; i < before.size(); ++i) differences.push_back(after[i] - before[i]);
  const RankTest test = signed_rank(differences);
  CHECK(test.p == Approx(0.0390625));
  CHECK(test.effect == Approx((2.0 - 7.0) / 9));
}

TEST_CASE("rank tests: signed ranks of few pairs have the p that all choices of signs give") {
  RandomStream random(2019, 0);
  for (int repeat = 0; repeat < 120; ++repeat) {
    // Few levels have ties and pairs without a difference; 0 is none.
    const double levels = repeat % 7;
    Values differences(1 + static_cast<std::size_t>(repeat) % 12);
    for (double& value : differences) {
      const double at = random.next_double();
      value = levels == 0 ? at - 0.3 : std::floor(levels * at) - 1;
    }
    INFO(repeat);
    CHECK(signed_rank(differences).p == Approx(exact_p(differences)).epsilon(1e-12));
  }
}

TEST_CASE("rank tests: where the exact p ends, the normal distribution is near to it") {
  RandomStream random(2019, 1);
  for (int repeat = 0; repeat < 20; ++repeat) {
    Values differences(kMostExactPairs), sizes;
    for (double& value : differences) {
      value = std::floor(9 * random.next_double()) - 3;
      sizes.push_back(std::abs(value));
    }
    const Ranks ranks = ranks_of(sizes);
    double off = 0, squares = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (sizes[i] == 0) continue;
      off += std::copysign(ranks.of[i] / 2, differences[i]);
      squares += ranks.of[i] * ranks.of[i] / 4;
    }
    CHECK(signed_rank(differences).p == Approx(rank_sum_p(off, squares)).margin(0.01));
  }
  const int most = static_cast<int>(kMostExactPairs);
  CHECK(signed_rank(Values(kMostExactPairs, 1.0)).p == Approx(std::ldexp(2.0, -most)));
  CHECK(signed_rank(Values(kMostExactPairs + 1, 1.0)).p > std::ldexp(2.0, -most));
}

TEST_CASE("rank tests: with equal values, a small p is near to what all choices give") {
  RandomStream random(2026, 0);
  double worst = 0;
  for (int repeat = 0; repeat < 60; ++repeat) {
    const double levels = 3 + repeat % 6;
    Values first(6), second(7);
    for (Values* values : {&first, &second}) {
      for (double& value : *values) value = std::floor(levels * random.next_double());
    }
    // Where p is large, it says nothing, and a normal distribution is far from so few values.
    const double exact = exact_p(first, second);
    if (exact < 0.1) worst = std::max(worst, std::abs(mann_whitney(first, second).p - exact));
  }
  CHECK(worst > 0);
  CHECK(worst < 0.05);
}

TEST_CASE("rank tests: what is equal but for rounding is tied, so seconds say what ticks say") {
  RandomStream random(2026, 1);
  int broken = 0;  // where the ties of the seconds are not those of the ticks
  for (const double period : {0.01, 0.001, 1.0 / 30, 0.1}) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      Values ticks, seconds, roundings;
      for (int pair = 0; pair < 12; ++pair) {
        const double a = std::floor(40 * random.next_double()) + 100;
        const double b = std::floor(8 * random.next_double()) + a - 3;
        ticks.push_back(b - a);
        seconds.push_back(b * period - a * period);
        roundings.push_back(rounding_of(b * period));
      }
      Values sizes;
      for (std::size_t i = 0; i < seconds.size(); ++i) {
        sizes.push_back(std::abs(seconds[i]) > roundings[i] ? std::abs(seconds[i]) : 0);
      }
      const double before = ranks_of(sizes).ties;
      tie_equal(sizes, roundings);
      for (double& size : ticks) size = std::abs(size);
      CHECK(ranks_of(sizes).of == ranks_of(ticks).of);
      CHECK(ranks_of(sizes).ties == ranks_of(ticks).ties);
      broken += before != ranks_of(ticks).ties ? 1 : 0;
    }
  }
  CHECK(broken > 50);
  Values apart{1.7e9, 1.7e9 + 0.001, -0.0, 0.0, 1e-300, 3e-300};
  const Values as_it_was = apart;
  Values roundings;
  for (const double value : apart) roundings.push_back(rounding_of(value));
  tie_equal(apart, roundings);
  CHECK(apart == as_it_was);
}

TEST_CASE("rank tests: a pair without a difference has a rank") {
  // By hand: ranks 4 to 9 for 2 to 7, 3 for -1. Of the 128 choices of their signs, those with a
  // negative sum of at most 3 are as far: none and -1 alone; and as many on the other side.
  const Values few{0, 0, 2, 3, 4, 5, 6, 7, -1};
  CHECK(signed_rank(few).p == Approx(4.0 / 128));
  CHECK(signed_rank(few).effect == Approx(5.0 / 9));
  // Without it, p would be 0.017 of these, and 0.12 or more when all are a little larger or
  // smaller.
  Values many(20, 0.0);
  for (int size = 1; size <= 100; ++size) many.push_back(size <= 60 ? -size : size);
  const auto p_after = [&](double by) {
    Values shifted = many;
    for (double& value : shifted) value += by;
    return signed_rank(shifted).p;
  };
  CHECK(p_after(1e-9) < p_after(0));
  CHECK(p_after(0) < p_after(-1e-9));
}

TEST_CASE("rank tests: equal values say nothing") {
  CHECK(mann_whitney(Values{2, 2, 2}, Values{2, 2}).p == 1);
  CHECK(mann_whitney(Values{2, 2, 2}, Values{2, 2}).effect == 0);
  CHECK(mann_whitney(Values{1}, Values{2}).effect == 1);
  CHECK(signed_rank(Values{0, 0, 0}).p == 1);
  CHECK(signed_rank(Values{0, 0, 0}).effect == 0);
  CHECK(signed_rank(Values{0, 0, 0, 1}).effect == 0.25);
  CHECK(signed_rank(Values{1, -1, 1, -1}).p == 1);
}

TEST_CASE("rank tests: of what is the same, 5 of 100 comparisons are below 5 %") {
  constexpr int kRepeats = 1000;
  RandomStream random(2019, 0);
  int paired = 0, independent = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    Values first(30), second(40), differences(30);
    for (Values* values : {&first, &second}) {
      for (double& value : *values) value = -std::log1p(-random.next_double());
    }
    for (std::size_t i = 0; i < differences.size(); ++i) differences[i] = second[i] - first[i];
    paired += signed_rank(differences).p <= 0.05 ? 1 : 0;
    independent += mann_whitney(first, second).p <= 0.05 ? 1 : 0;
  }
  CHECK(paired == Approx(50).margin(21));  // three standard deviations
  CHECK(independent == Approx(50).margin(21));
}

TEST_CASE("rank tests: Holm multiplies by how many are left, and keeps the order") {
  CHECK(holm({}).empty());
  CHECK(holm(Values{0.04}) == Values{0.04});
  const Values adjusted = holm(Values{0.03, 0.01, 0.04, 0.005, 0.9});
  CHECK(adjusted[3] == Approx(0.025));
  CHECK(adjusted[1] == Approx(0.04));
  CHECK(adjusted[0] == Approx(0.09));
  CHECK(adjusted[2] == Approx(0.09));  // not 0.08: it is no smaller than one before it
  CHECK(adjusted[4] == Approx(0.9));
  CHECK(holm(Values{0.6, 0.7})[0] == 1);
}

}  // namespace lockstep::host
