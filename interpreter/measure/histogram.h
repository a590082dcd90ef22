// Counts durations in buckets whose width grows with their value, so that the quantiles of millions
// of tick periods cost a fixed 430 KB (as HdrHistogram does). Recording allocates nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "core/clock.h"

namespace lockstep {

class Histogram {
 public:
  // A negative duration counts as 0.
  void record(Nanoseconds duration);

  std::uint64_t count() const { return count_; }
  Nanoseconds max() const { return max_; }  // exact
  // The smallest duration that at least `fraction` (in [0, 1]) of all do not exceed, never too
  // small and at most 0.1 % too large; exact below 1024 ns; 0 when nothing was recorded.
  Nanoseconds quantile(double fraction) const;

 private:
  // 1024 buckets for each power of two: each is at most 1/1024 of its value wide.
  static constexpr unsigned kBits = 10;
  static constexpr std::uint64_t kPerOctave = 1u << kBits;
  static std::size_t bucket_of(std::uint64_t value);
  static std::uint64_t largest_of(std::size_t bucket);

  std::vector<std::uint64_t> buckets_ = std::vector<std::uint64_t>((64 - kBits) * kPerOctave);
  std::uint64_t count_ = 0;
  Nanoseconds max_{0};
};

}  // namespace lockstep
