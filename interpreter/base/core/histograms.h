// Histograms of many at once, as Histogram::kCoarse: of counts of any unit up to 2^40. They are
// stored by the size of what is counted, so memory is touched for the sizes that occur only.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/core/zeroed_memory.h"

namespace lockstep::host {

class Histograms {
 public:
  explicit Histograms(std::size_t many);

  static constexpr std::uint64_t kLargest = (std::uint64_t{1} << 40) - 1;

  // Allocates nothing. What is larger than kLargest counts as that.
  void record(std::size_t which, std::uint64_t value, std::uint32_t times = 1) {
    record_in_range(which, std::min(value, kLargest), times);
  }
  // The same of what is not larger.
  void record_in_range(std::size_t which, std::uint64_t value, std::uint32_t times) {
    std::uint32_t& count = at(which, value);
    if (__builtin_add_overflow(count, times, &count)) [[unlikely]]
      halve(which, count, times);
  }

  // How many values were recorded. From 2^32 in one bucket on it is rounded.
  std::uint64_t count(std::size_t which) const;
  // The smallest value that at least `fraction` (in [0, 1]) of all do not exceed, never too small
  // and at most a sixteenth too large; 0 when nothing was recorded.
  std::uint64_t quantile(std::size_t which, double fraction) const;

 private:
  // A row has the values of one number of binary digits, the first all that have up to four.
  static constexpr unsigned kBits = 4, kInRow = 1u << kBits, kRows = 37;
  static_assert(kLargest >> (kRows - 1 + kBits) == 0);

  std::uint32_t& at(std::size_t which, std::uint64_t value) {
    constexpr unsigned kWidest = std::numeric_limits<std::uint64_t>::digits - 1;
    const auto widest_bit = kWidest - static_cast<unsigned>(std::countl_zero(value | kInRow));
    const unsigned shift = widest_bit - kBits;
    const std::uint64_t leading = value >> shift;  // with the highest bit from the second row on
    return of(which, shift + (leading >> kBits))[leading & (kInRow - 1)];
  }
  std::uint32_t* of(std::size_t which, std::size_t row) {
    return &counts_[(row * many_ + which) * kInRow];
  }
  const std::uint32_t* of(std::size_t which, std::size_t row) const {
    return &counts_[(row * many_ + which) * kInRow];
  }
  void halve(std::size_t which, std::uint32_t& full, std::uint32_t times);

  std::size_t many_;
  std::vector<std::uint32_t, ZeroedMemory<std::uint32_t>> counts_;
};

}  // namespace lockstep::host
