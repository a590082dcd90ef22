#include "base/core/histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lockstep::host {

Histogram::Histogram(unsigned bits) : bits_(bits), buckets_((64 - std::size_t{bits}) << bits) {}

// Values below 2^bits have a bucket each; above, the top bits + 1 bits of a value name it.
std::size_t Histogram::bucket_of(std::uint64_t value) const {
  if (value >> bits_ == 0) return value;
  const auto shift = static_cast<unsigned>(std::bit_width(value)) - 1 - bits_;
  return (std::size_t{shift} << bits_) + (value >> shift);
}

std::uint64_t Histogram::largest_of(std::size_t bucket) const {
  if (bucket >> bits_ == 0) return bucket;
  const std::size_t shift = (bucket >> bits_) - 1;
  const std::uint64_t lowest = (bucket - (shift << bits_)) << shift;
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

std::vector<std::uint64_t> Histogram::by_digits() const {
  std::vector<std::uint64_t> counts;
  for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket) {
    if (buckets_[bucket] == 0) continue;
    const auto digits = static_cast<std::size_t>(std::bit_width(largest_of(bucket)));
    if (counts.size() <= digits) counts.resize(digits + 1);
    counts[digits] += buckets_[bucket];
  }
  return counts;
}

}  // namespace lockstep::host
