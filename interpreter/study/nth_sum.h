// Order statistics of sums, without a list of them: 10,000 values with 10,000 others have 10^8
// sums. How many are at most v takes one walk along both lists; the double v is found by bisection,
// which takes at most 64 walks and is exact (selection in X + Y: Johnson, Mizoguchi 1978).
#pragma once

#include <cstdint>
#include <span>

namespace lockstep::host {

// The n-th smallest, from 0, of all sums of a value of `x` and one of `y`. Both are ascending, and
// n < x.size() * y.size().
double nth_sum(std::span<const double> x, std::span<const double> y, std::uint64_t n);

// The same of the sums x[i] + x[j] with i <= j; n < x.size() * (x.size() + 1) / 2.
double nth_own_sum(std::span<const double> x, std::uint64_t n);

}  // namespace lockstep::host
