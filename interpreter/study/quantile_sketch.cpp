#include "study/quantile_sketch.h"

#include <algorithm>
#include <bit>

namespace lockstep::host {
namespace {

constexpr unsigned kFractionBits = 52;

}  // namespace

// Rises with the value.
std::int64_t QuantileSketch::place_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto size =
      static_cast<std::int64_t>((bits & ~(std::uint64_t{1} << 63u)) >> (kFractionBits - kBits));
  return bits >> 63u == 0 ? size : -1 - size;
}

QuantileSketch::Bucket& QuantileSketch::at(std::int64_t place) {
  const auto in_page = static_cast<std::size_t>(place) % std::tuple_size_v<Page>;
  return pages_[place >> kBits][in_page];
}

void QuantileSketch::add(double value) {
  add(Bucket{value, value, 1});
}

bool QuantileSketch::add(const Bucket& bucket) {
  // The sketch knows one of the two zeros.
  const double low = bucket.low + 0.0, high = bucket.high + 0.0;
  const std::int64_t place = place_of(low);
  if (!(low <= high) || place != place_of(high) || bucket.count < (low < high ? 2u : 1u))
    return false;
  Bucket& there = at(place);
  there.low = there.count == 0 ? low : std::min(there.low, low);
  there.high = there.count == 0 ? high : std::max(there.high, high);
  there.count += bucket.count;
  count_ += bucket.count;
  return true;
}

void QuantileSketch::add(const QuantileSketch& other) {
  for (const Bucket& bucket : other.buckets()) add(bucket);
}

std::vector<QuantileSketch::Bucket> QuantileSketch::buckets() const {
  std::vector<Bucket> all;
  for (const auto& [number, page] : pages_) {
    std::ranges::copy_if(page, std::back_inserter(all), [](auto& it) { return it.count != 0; });
  }
  return all;
}

}  // namespace lockstep::host
