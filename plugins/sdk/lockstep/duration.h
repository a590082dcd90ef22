// How long a wait may be: the one place where a duration that an author gives becomes a time that
// can be added to that of a clock. A time point counts nanoseconds in 64 bits, which end after 292
// years, so `now + hours::max()` is in the past and such a wait would end at once.
#pragma once

#include <chrono>

namespace lockstep {
inline namespace sdk1 {

// A hundred years: a longer or endless wait lasts this long, on every clock.
constexpr std::chrono::hours kLongestWait{24 * 365 * 100};

// Nothing where the duration is negative, or not a number.
template <class Rep, class Period>
constexpr std::chrono::nanoseconds bounded(std::chrono::duration<Rep, Period> duration) {
  const std::chrono::duration<double> seconds = duration;
  if (!(seconds.count() > 0)) return std::chrono::nanoseconds(0);
  if (seconds >= kLongestWait) return kLongestWait;
  return std::chrono::duration_cast<std::chrono::nanoseconds>(duration);
}

}  // namespace sdk1
}  // namespace lockstep
