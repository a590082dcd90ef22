// How much larger one sample is than another: the estimate of Hodges and Lehmann (1963), and all
// shifts that the rank test of the same samples does not reject at 5 % (Hollander, Wolfe 1999, 3.3
// and 4.3). If no values of both samples are equal, the interval contains 0 exactly if p is at
// least 0.05. If some are, p may be smaller while the interval still has 0, mostly as an end. It
// always has the estimate, and is that alone where each shift is rejected.
#pragma once

#include <optional>
#include <span>

#include "study/intervals.h"

namespace lockstep::host {

struct Shift {
  double estimate = 0;
  std::optional<Interval> interval = {};  // nothing if the test rejects no shift
};

// The median of all differences of a value of `second` and one of `first`; the interval is of
// mann_whitney(). Neither is empty.
Shift shift_between(std::span<const double> first, std::span<const double> second);

// The median of the means of each two differences, and of each with itself (Walsh averages); the
// interval is of signed_rank(). At least one.
Shift shift_of(std::span<const double> differences);

}  // namespace lockstep::host
