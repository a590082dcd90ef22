// Numbers in as few bytes as they need: seven bits in each byte, the lowest first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lockstep::host {

inline void put_number(std::vector<std::byte>& to, std::uint64_t number) {
  for (; number >= 128; number >>= 7u) to.push_back(static_cast<std::byte>(number | 128u));
  to.push_back(static_cast<std::byte>(number));
}

// Takes one from the front.
inline std::uint64_t take_number(std::span<const std::byte>& from) {
  std::uint64_t number = 0;
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    const auto part = std::to_integer<std::uint64_t>(from[count]);
    number |= (part & 127u) << 7 * count;
    more = part >= 128;
  }
  from = from.subspan(count);
  return number;
}

}  // namespace lockstep::host
