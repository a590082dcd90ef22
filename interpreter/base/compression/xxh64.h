// The hash XXH64 (RFC 8878 names it), whose lower half is the checksum of a frame of zstd.
// Async-signal-safe.
#pragma once

#include <cstdint>
#include <string_view>

namespace lockstep::host {

// With the seed 0.
std::uint64_t xxh64(std::string_view text) noexcept;

}  // namespace lockstep::host
