#include "study/ranks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "study/distributions.h"

namespace lockstep::host {

namespace {

// The places of the values, by rising value.
std::vector<std::size_t> order_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  return order;
}

}  // namespace

void tie_equal(std::span<double> values, std::span<const double> roundings) {
  std::optional<std::size_t> first;  // of those that are equal
  for (const std::size_t place : order_of(values)) {
    const double apart = first ? values[place] - values[*first] : 0;
    if (!first || apart > std::max(roundings[*first], roundings[place])) first = place;
    values[place] = values[*first];
  }
}

void tie_differences(std::span<double> differences, std::span<const double> roundings) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const double size = std::abs(differences[i]);
    sizes.push_back(size > roundings[i] ? size : 0);
  }
  tie_equal(sizes, roundings);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    differences[i] = sizes[i] == 0 ? 0 : std::copysign(sizes[i], differences[i]);
  }
}

Ranks ranks_of(std::span<const double> values) {
  const std::vector<std::size_t> order = order_of(values);
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

double rank_sum_variance(double first, double second, double ties) {
  const double all = first + second;
  return first * second / 12 * (all + 1 - ties / (all * (all - 1)));
}

double signed_rank_variance(double count, double zeros, double ties) {
  const auto squares = [](double n) { return n * (n + 1) * (2 * n + 1); };  // of 1 to n, six times
  return (squares(count) - squares(zeros)) / 24 - ties / 48;
}

double rank_sum_p(double off, double variance) {
  if (variance <= 0) return 1;
  return normal_two_sided(std::max(0.0, std::abs(off) - 0.5) / std::sqrt(variance));
}

}  // namespace lockstep::host
