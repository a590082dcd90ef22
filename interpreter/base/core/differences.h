// Finds where two arrays of bytes differ, eight at a time: where little has changed, it costs
// almost nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace lockstep::host {

// Visits each index at which they differ; `other` is as long.
template <class Byte, class Visit>
void for_each_difference(std::span<const Byte> one, const std::uint8_t* other, Visit visit) {
  static_assert(sizeof(Byte) == 1);
  const auto eight = [](const void* bytes) {
    std::uint64_t block = 0;
    std::memcpy(&block, bytes, sizeof block);
    return block;
  };
  std::size_t at = 0;
  for (; at + 8 <= one.size(); at += 8) {
    if (eight(&one[at]) == eight(other + at)) continue;
    for (std::size_t i = at; i < at + 8; ++i) {
      if (static_cast<std::uint8_t>(one[i]) != other[i]) visit(static_cast<std::uint32_t>(i));
    }
  }
  for (; at < one.size(); ++at) {
    if (static_cast<std::uint8_t>(one[at]) != other[at]) visit(static_cast<std::uint32_t>(at));
  }
}

}  // namespace lockstep::host
