// Counts durations in buckets whose width grows with their value (as HdrHistogram does), so the
// quantiles of millions of durations need a fixed amount of memory. Recording allocates nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "base/core/clock.h"
#include "base/core/zeroed_memory.h"

namespace lockstep::host {

class Histogram {
 public:
  static constexpr unsigned kFine = 10;   // a thousandth too large at most; 430 KB
  static constexpr unsigned kCoarse = 4;  // a sixteenth; 8 KB

  // 2^bits buckets for each power of two, so that each is at most 1/2^bits of its value wide.
  explicit Histogram(unsigned bits = kFine);

  // A negative duration counts as 0.
  void record(Nanoseconds duration);

  std::uint64_t count() const { return count_; }
  Nanoseconds max() const { return max_; }  // exact
  // The smallest duration that at least `fraction` (in [0, 1]) of all do not exceed, never too
  // small and at most 1/2^bits too large; exact below 2^bits ns; 0 when nothing was recorded.
  Nanoseconds quantile(double fraction) const;
  // How many durations had so many binary digits in ns: [0] are those of 0, [1] of 1 ns, [2] of 2
  // and 3 ns, … up to the largest.
  std::vector<std::uint64_t> by_digits() const;

 private:
  std::size_t bucket_of(std::uint64_t value) const;
  std::uint64_t largest_of(std::size_t bucket) const;

  unsigned bits_;
  std::vector<std::uint64_t, ZeroedMemory<std::uint64_t>> buckets_;
  std::uint64_t count_ = 0;
  Nanoseconds max_{0};
};

}  // namespace lockstep::host
