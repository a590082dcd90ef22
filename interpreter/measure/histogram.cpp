#include "measure/histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lockstep {

// Values below kPerOctave have a bucket each; above, the top kBits + 1 bits of a value name it.
std::size_t Histogram::bucket_of(std::uint64_t value) {
  if (value < kPerOctave) return value;
  const auto shift = static_cast<unsigned>(std::bit_width(value)) - 1 - kBits;
  return (shift + 1) * kPerOctave + ((value >> shift) - kPerOctave);
}

std::uint64_t Histogram::largest_of(std::size_t bucket) {
  if (bucket < kPerOctave) return bucket;
  const std::size_t shift = bucket / kPerOctave - 1;
  const std::uint64_t lowest = (kPerOctave + bucket % kPerOctave) << shift;
  return lowest + ((std::uint64_t{1} << shift) - 1);
}

void Histogram::record(Nanoseconds duration) {
  duration = std::max(duration, Nanoseconds(0));
  ++buckets_[bucket_of(static_cast<std::uint64_t>(duration.count()))];
  ++count_;
  max_ = std::max(max_, duration);
}

Nanoseconds Histogram::quantile(double fraction) const {
  if (count_ == 0) return Nanoseconds(0);
  const double exact_rank = std::ceil(fraction * static_cast<double>(count_));
  const auto rank = std::clamp<std::uint64_t>(static_cast<std::uint64_t>(exact_rank), 1, count_);
  std::uint64_t seen = 0;
  std::size_t bucket = 0;
  while ((seen += buckets_[bucket]) < rank) ++bucket;
  return std::min(max_, Nanoseconds(static_cast<std::int64_t>(largest_of(bucket))));
}

}  // namespace lockstep
