#include "study/rank_tests.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "study/ranks.h"

namespace lockstep::host {

namespace {

// How likely a sum of the ranks of the positive ones is as far from its mean, if each sign is as
// likely. Ranks count twice here, so tied ones are whole numbers too; those without a sign are left
// out. The sums up to the smaller of both sides are enough: the distribution is symmetric.
double all_signs_p(std::span<const std::size_t> ranks, std::size_t smaller_side) {
  std::vector<double> likelihood(smaller_side + 1);
  likelihood[0] = 1;
  for (const std::size_t rank : ranks) {
    for (std::size_t sum = smaller_side + 1; sum-- > 0;) {
      likelihood[sum] = (likelihood[sum] + (sum < rank ? 0 : likelihood[sum - rank])) / 2;
    }
  }
  return std::min(1.0, 2 * std::accumulate(likelihood.begin(), likelihood.end(), 0.0));
}

double all_signs_p(std::span<const double> differences, const Ranks& ranks) {
  std::vector<std::size_t> doubled;
  std::size_t negative = 0, positive = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    if (differences[i] == 0) continue;
    doubled.push_back(static_cast<std::size_t>(2 * ranks.of[i]));
    (differences[i] > 0 ? positive : negative) += doubled.back();
  }
  return all_signs_p(doubled, std::min(negative, positive));
}

}  // namespace

RankTest mann_whitney(std::span<const double> first, std::span<const double> second) {
  std::vector<double> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  const Ranks ranks = ranks_of(all);
  const auto m = static_cast<double>(first.size()), n = static_cast<double>(second.size());
  const double sum = std::accumulate(ranks.of.end() - std::ssize(second), ranks.of.end(), 0.0);
  const double off = sum - n * (n + m + 1) / 2;
  return {.effect = 2 * off / (m * n), .p = rank_sum_p(off, rank_sum_variance(m, n, ranks.ties))};
}

RankTest signed_rank(std::span<const double> differences) {
  std::vector<double> sizes;
  for (const double difference : differences) sizes.push_back(std::abs(difference));
  const Ranks ranks = ranks_of(sizes);
  double off = 0, larger = 0, zeros = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const double sign = differences[i] > 0 ? 1 : differences[i] < 0 ? -1 : 0;
    off += sign * ranks.of[i] / 2;
    larger += sign;
    zeros += sign == 0 ? 1 : 0;
  }
  const auto n = static_cast<double>(differences.size());
  if (differences.size() <= kMostExactPairs) {
    return {.effect = larger / n, .p = all_signs_p(differences, ranks)};
  }
  const double ties = ranks.ties - (zeros * zeros * zeros - zeros);
  return {.effect = larger / n, .p = rank_sum_p(off, signed_rank_variance(n, zeros, ties))};
}

std::vector<double> holm(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> adjusted(p.size());
  double before = 0;
  auto left = static_cast<double>(p.size());
  for (const std::size_t i : order) {
    before = adjusted[i] = std::clamp(left * p[i], before, 1.0);
    --left;
  }
  return adjusted;
}

}  // namespace lockstep::host
