#include "base/core/deadlines.h"

#include <cmath>

namespace lockstep::host {

Deadlines::Deadlines(double rate) : rate_(rate) {
  const double period = 1e9 / rate;
  const bool is_whole = period == std::floor(period) && std::fma(period, rate, -1e9) == 0;
  period_ = is_whole ? static_cast<std::uint64_t>(period) : 0;
}

Nanoseconds Deadlines::divided(std::uint64_t k) const {
  return deadline_of(k, rate_);
}

Nanoseconds Deadlines::whole_periods(Nanoseconds time) const {
  constexpr Nanoseconds kRoundings = std::chrono::microseconds(1);  // of many times
  if (time < Nanoseconds(0)) return time;
  const Nanoseconds whole = divided(static_cast<std::uint64_t>(to_seconds(time) * rate_ + 0.5));
  return std::chrono::abs(whole - time) <= kRoundings ? whole : time;
}

double Deadlines::exact_seconds(Nanoseconds time) const {
  if (time < Nanoseconds(0)) return to_seconds(time);
  const auto periods = static_cast<std::uint64_t>(to_seconds(time) * rate_ + 0.5);
  return divided(periods) == time ? static_cast<double>(periods) / rate_ : to_seconds(time);
}

std::uint64_t Deadlines::first_from(Nanoseconds time) const {
  // The product is rounded, so it may be off by one.
  auto k = static_cast<std::uint64_t>(to_seconds(time) * rate_);
  while (k > 0 && at(k - 1) >= time) --k;
  while (at(k) < time) ++k;
  return k;
}

Nanoseconds deadline_of(std::uint64_t k, double rate) {
  return Nanoseconds(std::llround(static_cast<long double>(k) * 1e9L / rate));
}

}  // namespace lockstep::host
