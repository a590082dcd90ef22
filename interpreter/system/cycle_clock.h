// A clock for short durations: the counter of the processor where it counts time evenly (the TSC of
// x86-64 if it is invariant, CNTVCT of aarch64), else the system's monotonic clock, which takes
// three times as long to read. For one thread.
#pragma once

#include <cstdint>

#include "core/clock.h"

namespace lockstep::host {

class CycleClock {
 public:
  // Compares the counter with the system's clock for some microseconds.
  CycleClock();

  // Since some moment. From one reading to the next it does not decrease, but `adjust` may come
  // between them.
  Nanoseconds now() const {
#if defined(__x86_64__) || defined(__aarch64__)
    if (scale_ != 0) [[likely]]
      return scaled(counter() - counter_);
#endif
    return monotonic_now();
  }
  // Compares the two again over all the time since the clock was made: the longer, the more exact.
  void adjust();

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
  Nanoseconds scaled(std::uint64_t count) const {
    __extension__ using Wide = unsigned __int128;
    return Nanoseconds(static_cast<std::int64_t>((Wide{count} * scale_) >> kShift));
  }

  static constexpr unsigned kShift = 32;
  Nanoseconds system_{0};  // both were read at the same moment
  std::uint64_t counter_ = 0;
  std::uint64_t scale_ = 0;  // nanoseconds of a count, times 2^kShift; 0: the counter is not used
};

}  // namespace lockstep::host
