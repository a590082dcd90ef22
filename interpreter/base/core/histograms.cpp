#include "base/core/histograms.h"

#include <cmath>

namespace lockstep::host {

Histograms::Histograms(std::size_t many) : many_(many), counts_(many * kRows * kInRow) {}

std::uint64_t Histograms::count(std::size_t which) const {
  std::uint64_t all = 0;
  for (unsigned row = 0; row < kRows; ++row) {
    for (unsigned i = 0; i < kInRow; ++i) all += of(which, row)[i];
  }
  return all;
}

std::uint64_t Histograms::quantile(std::size_t which, double fraction) const {
  const std::uint64_t all = count(which);
  const double exact_rank = std::ceil(fraction * static_cast<double>(all));
  const auto rank = std::max<std::uint64_t>(static_cast<std::uint64_t>(exact_rank), 1);
  std::uint64_t seen = 0;
  for (unsigned bucket = 0; bucket < kRows * kInRow; ++bucket) {
    const unsigned row = bucket / kInRow, in_row = bucket % kInRow;
    seen += of(which, row)[in_row];
    if (seen < rank) continue;
    if (row == 0) return in_row;
    return ((std::uint64_t{kInRow} + in_row + 1) << (row - 1)) - 1;
  }
  return 0;
}

// A bucket has overflown: all of them go on from half of what they had, in the same proportions.
void Histograms::halve(std::size_t which, std::uint32_t& full, std::uint32_t times) {
  full -= times;
  for (unsigned row = 0; row < kRows; ++row) {
    for (unsigned i = 0; i < kInRow; ++i) of(which, row)[i] /= 2;
  }
  full += times;
}

}  // namespace lockstep::host
