// Ranks of values, and how far a sum of them is from its mean by chance. What the tests of ranks
// and the intervals of shifts have in common, so that they agree.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace lockstep::host {

// How far a value, or a difference of two of them, may be off by the rounding of doubles: a measure
// in seconds is a number of ticks times a period. The factor is 2^-44.
inline double rounding_of(double largest) {
  return std::abs(largest) * 0x1p-44;
}
// Makes values equal that differ by no more than the larger of their roundings. So 1.23 - 1.2 and
// 0.53 - 0.5 are tied, as 3 ticks and 3 ticks are.
void tie_equal(std::span<double> values, std::span<const double> roundings);
// The same of the sizes of differences. One within its rounding is none.
void tie_differences(std::span<double> differences, std::span<const double> roundings);

struct Ranks {
  std::vector<double> of;  // each value, from 1; equal ones share theirs
  double ties = 0;         // the sum of t^3 - t over groups of t equal values
};

Ranks ranks_of(std::span<const double> values);

// The variance of the sum of the ranks that one of two samples of these sizes has among both
// (Hollander, Wolfe 1999, 4.1).
double rank_sum_variance(double first, double second, double ties);
// The variance of half of the sum of the ranks of |differences|, each with the sign of its
// difference. Zeros have ranks, but no sign (Pratt 1959); `ties` are those of the others
// (Hollander, Wolfe 1999, 3.1).
double signed_rank_variance(double count, double zeros, double ties);

// How likely a sum is so far from its mean, two-sided: from the normal distribution, with a
// correction for continuity. 1 without variance: all values are equal.
double rank_sum_p(double off, double variance);

}  // namespace lockstep::host
