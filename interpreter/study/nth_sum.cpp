#include "study/nth_sum.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace lockstep::host {
namespace {

constexpr std::int64_t kMinusZero = std::numeric_limits<std::int64_t>::min();

// Doubles in their order, one after the other; 0 for both zeros.
std::int64_t place_of(double value) {
  const auto bits = std::bit_cast<std::int64_t>(value);
  return bits >= 0 ? bits : kMinusZero - bits;
}

double double_at(std::int64_t place) {
  return std::bit_cast<double>(place >= 0 ? place : kMinusZero - place);
}

std::uint64_t sums_up_to(double most, std::span<const double> x, std::span<const double> y) {
  std::uint64_t count = 0;
  std::size_t end = y.size();  // of those that are small enough for the x of this step
  for (const double value : x) {
    while (end > 0 && value + y[end - 1] > most) --end;
    count += end;
  }
  return count;
}

// The least double in [least, most] up to which there are more than n.
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
    return (sums_up_to(most, x, x) + own) / 2;  // x[i] + x[j] is x[j] + x[i]
  });
}

}  // namespace lockstep::host
