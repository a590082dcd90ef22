#include "study/rank_tests.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "study/distributions.h"

namespace lockstep {
namespace {

struct Ranks {
  std::vector<double> of;  // each value, from 1; equal ones share theirs
  double ties = 0;         // the sum of t^3 - t over groups of t equal values
};

template <class Key>
std::vector<std::size_t> order_by(std::size_t count, Key key) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, key);
  return order;
}

Ranks ranks_of(std::span<const double> values) {
  const auto order = order_by(values.size(), [&](std::size_t i) { return values[i]; });
  Ranks ranks{.of = std::vector<double>(values.size())};
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    const double rank = static_cast<double>(first + 1 + end) / 2;
    for (std::size_t i = first; i < end; ++i) ranks.of[order[i]] = rank;
    const auto equal = static_cast<double>(end - first);
    ranks.ties += equal * equal * equal - equal;
  }
  return ranks;
}

// Of a sum of ranks that is `off` its mean.
double two_sided(double off, double variance) {
  if (variance <= 0) return 1;  // all values are equal
  return normal_two_sided(std::max(0.0, std::abs(off) - 0.5) / std::sqrt(variance));
}

}  // namespace

RankTest mann_whitney(std::span<const double> first, std::span<const double> second) {
  std::vector<double> all(first.begin(), first.end());
  all.insert(all.end(), second.begin(), second.end());
  const Ranks ranks = ranks_of(all);
  const auto m = static_cast<double>(first.size()), n = static_cast<double>(second.size());
  const double sum = std::accumulate(ranks.of.end() - std::ssize(second), ranks.of.end(), 0.0);
  const double off = sum - n * (n + m + 1) / 2;
  const double variance = m * n / 12 * (m + n + 1 - ranks.ties / ((m + n) * (m + n - 1)));
  return {.effect = 2 * off / (m * n), .p = two_sided(off, variance)};
}

RankTest signed_rank(std::span<const double> differences) {
  std::vector<double> sizes, signs;
  for (const double difference : differences) {
    if (difference == 0) continue;
    sizes.push_back(std::abs(difference));
    signs.push_back(difference > 0 ? 1 : -1);
  }
  const Ranks ranks = ranks_of(sizes);
  const auto n = static_cast<double>(sizes.size());
  const double off = std::inner_product(signs.begin(), signs.end(), ranks.of.begin(), 0.0) / 2;
  const double variance = n * (n + 1) * (2 * n + 1) / 24 - ranks.ties / 48;
  const double larger = std::accumulate(signs.begin(), signs.end(), 0.0);
  return {.effect = larger / static_cast<double>(differences.size()),
          .p = two_sided(off, variance)};
}

std::vector<double> holm(std::span<const double> p) {
  std::vector<double> adjusted(p.size());
  double before = 0;
  auto left = static_cast<double>(p.size());
  for (const std::size_t i : order_by(p.size(), [&](std::size_t at) { return p[at]; })) {
    before = adjusted[i] = std::clamp(left * p[i], before, 1.0);
    --left;
  }
  return adjusted;
}

}  // namespace lockstep
