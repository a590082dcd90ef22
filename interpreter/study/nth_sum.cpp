#include "study/nth_sum.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace lockstep::host {
namespace {

constexpr std::int64_t kMinusZero = std::numeric_limits<std::int64_t>::min();

// The bits of doubles rise with the numbers, but for negative ones, where they fall: mirrored, they
// number all doubles in their order. 0.1 and the next double are neighbors, and both zeros are 0.
std::int64_t place_of(double value) {
  const auto bits = std::bit_cast<std::int64_t>(value);
  return bits >= 0 ? bits : kMinusZero - bits;
}

double double_at(std::int64_t place) {
  return std::bit_cast<double>(place >= 0 ? place : kMinusZero - place);
}

std::uint64_t sums_up_to(double most, std::span<const double> x, std::span<const double> y) {
  std::uint64_t count = 0;
  std::size_t end = y.size();  // before it, y is small enough for the x of this step
  for (const double value : x) {
    while (end > 0 && value + y[end - 1] > most) --end;
    count += end;
  }
  return count;
}

// The least double in [least, most] up to which there are more than n, which is itself a sum: the
// count rises only there. Example: for n = 0 it is `least`, up to which there is one sum at least.
template <class Count>
double nth(double least, double most, std::uint64_t n, Count count) {
  std::int64_t low = place_of(least), high = place_of(most);
  while (low < high) {
    const std::int64_t middle = std::midpoint(low, high);
    if (count(double_at(middle)) > n) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return double_at(low);
}

}  // namespace

double nth_sum(std::span<const double> x, std::span<const double> y, std::uint64_t n) {
  return nth(x.front() + y.front(), x.back() + y.back(), n,
             [&](double most) { return sums_up_to(most, x, y); });
}

double nth_own_sum(std::span<const double> x, std::uint64_t n) {
  return nth(x.front() + x.front(), x.back() + x.back(), n, [&](double most) {
    const auto twice = [&](double value) { return value + value <= most; };
    const auto own = static_cast<std::uint64_t>(std::ranges::partition_point(x, twice) - x.begin());
    // Each pair was counted as x[i] + x[j] and as x[j] + x[i], but x[i] + x[i] once.
    return (sums_up_to(most, x, x) + own) / 2;
  });
}

}  // namespace lockstep::host
