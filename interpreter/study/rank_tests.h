// Two samples: does one tend to be larger? By ranks, so without an assumption about distributions.
// p is two-sided. That of a few pairs is exact; the others come from the normal distribution, with
// corrections for ties and continuity.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lockstep::host {

struct RankTest {
  // The share of all pairs of a value of either in which the second is larger, less the share in
  // which it is smaller. From -1 to 1; Cliff's delta.
  double effect = 0;
  double p = 1;
};

// Mann-Whitney, of samples that have nothing to do with each other. Neither is empty.
RankTest mann_whitney(std::span<const double> first, std::span<const double> second);

// Of up to so many pairs, p counts all choices of signs: the distribution is exact, with ties too.
constexpr std::size_t kMostExactPairs = 40;

// Wilcoxon's signed ranks, of the differences within pairs, second less first; at least one. Pairs
// without a difference have ranks and no sign, as Pratt (1959) has it. Without their ranks, the
// test may reject a shift of 0 but not the shifts around it.
RankTest signed_rank(std::span<const double> differences);

// Holm: what each p is when all are looked at.
std::vector<double> holm(std::span<const double> p);

}  // namespace lockstep::host
