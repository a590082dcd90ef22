// A clock for short durations: the counter of the processor where it counts time evenly (the TSC of
// x86-64 if it is invariant, CNTVCT of aarch64), else the system's monotonic clock, which takes
// three times as long to read. For one thread.
#pragma once

#include <cstdint>

#include "base/core/clock.h"

namespace lockstep::host {

class CycleClock {
 public:
  // Compares the counter with the system's clock for some microseconds.
  CycleClock();

  // A count since some moment, for time_of. It does not decrease while a thread stays on its
  // processor; on another one it may be a little less.
  std::int64_t count() const {
#if defined(__x86_64__) || defined(__aarch64__)
    if (scale_ != 0) [[likely]]
      return static_cast<std::int64_t>(counter());
#endif
    return monotonic_now().count();
  }
  // The difference of two counts as a time, and a time as a difference. Not of a negative one.
  Nanoseconds time_of(std::int64_t count) const {
    __extension__ using Wide = unsigned __int128;
    if (scale_ == 0) return Nanoseconds(count);
    return Nanoseconds(static_cast<std::int64_t>((static_cast<Wide>(count) * scale_) >> kShift));
  }
  std::int64_t count_of(Nanoseconds time) const {
    __extension__ using Wide = unsigned __int128;
    if (scale_ == 0) return time.count();
    return static_cast<std::int64_t>((static_cast<Wide>(time.count()) << kShift) / scale_);
  }
  // Compares the two again over all the time since the clock was made: the longer, the more exact.
  // Returns the time on the system's clock, at which the count was that.
  struct Reading {
    Nanoseconds time;
    std::int64_t count;
  };
  Reading adjust();

 private:
  static std::uint64_t counter() {
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();
#elif defined(__aarch64__)
    std::uint64_t count;
    asm volatile("mrs %0, cntvct_el0" : "=r"(count));
    return count;
#else
    return 0;
#endif
  }

  static constexpr unsigned kShift = 32;
  Nanoseconds system_{0};  // both were read at the same moment
  std::uint64_t counter_ = 0;
  std::uint64_t scale_ = 0;  // nanoseconds of a count, times 2^kShift; 0: the counter is not used
};

}  // namespace lockstep::host
