#include "base/compression/xxh64.h"

#include <array>
#include <bit>
#include <cstring>

namespace lockstep::host {
namespace {

constexpr std::uint64_t kPrime[] = {0,
                                    0x9E3779B185EBCA87,
                                    0xC2B2AE3D27D4EB4F,
                                    0x165667B19E3779F9,
                                    0x85EBCA77C2B2AE63,
                                    0x27D4EB2F165667C5};

// Takes the bytes of a number, least first, off the front.
template <class Number>
std::uint64_t take(std::string_view& text) {
  static_assert(std::endian::native == std::endian::little);
  Number number;
  std::memcpy(&number, text.data(), sizeof number);
  text.remove_prefix(sizeof number);
  return number;
}

std::uint64_t mixed(std::uint64_t lane, std::uint64_t input) {
  return std::rotl(lane + input * kPrime[2], 31) * kPrime[1];
}

}  // namespace

std::uint64_t xxh64(std::string_view text) noexcept {
  const std::uint64_t length = text.size();
  std::uint64_t hash = kPrime[5];
  if (text.size() >= 32) {
    std::array<std::uint64_t, 4> lanes{kPrime[1] + kPrime[2], kPrime[2], 0, 0 - kPrime[1]};
    while (text.size() >= 32) {
      for (std::uint64_t& lane : lanes) lane = mixed(lane, take<std::uint64_t>(text));
    }
    hash = std::rotl(lanes[0], 1) + std::rotl(lanes[1], 7) + std::rotl(lanes[2], 12) +
           std::rotl(lanes[3], 18);
    for (const std::uint64_t lane : lanes) hash = (hash ^ mixed(0, lane)) * kPrime[1] + kPrime[4];
  }
  hash += length;
  while (text.size() >= 8)
    hash = std::rotl(hash ^ mixed(0, take<std::uint64_t>(text)), 27) * kPrime[1] + kPrime[4];
  if (text.size() >= 4)
    hash = std::rotl(hash ^ take<std::uint32_t>(text) * kPrime[1], 23) * kPrime[2] + kPrime[3];
  while (!text.empty())
    hash = std::rotl(hash ^ take<std::uint8_t>(text) * kPrime[5], 11) * kPrime[1];
  hash = (hash ^ (hash >> 33)) * kPrime[2];
  hash = (hash ^ (hash >> 29)) * kPrime[3];
  return hash ^ (hash >> 32);
}

}  // namespace lockstep::host
