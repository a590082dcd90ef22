// The n-th smallest of all sums of two values, without a list of the sums: two cells of a study
// with 10,000 runs each have 10^8. `study compare` needs it for the interval of a shift (the median
// of all differences y - x) and of a paired one (the median of all means of two differences).
//
// The walk. For x = 1 4 6 and y = 0 2 5, how many sums are at most 6?
//   1 + 5 is: all 3 of y.  4 + 5 is not, 4 + 2 is: 2.  6 + 2 is not, 6 + 0 is: 1.  So 6.
// As x rises, the end in y only falls, so one walk along both lists finds the number. The n-th sum
// is then the least double up to which there are more than n, which bisection finds: over the order
// of all doubles, not by halving distances, so it takes at most 64 walks and the result is exact
// (selection in X + Y: Johnson and Mizoguchi 1978).
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
