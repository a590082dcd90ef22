// CRC-32C (Castagnoli), the checksum of iSCSI and ext4. zlib has another one, CRC-32.
#pragma once

#include <cstdint>
#include <string_view>

namespace lockstep::host {

// Of the bytes after those of which `before` is the checksum. Of "123456789": 0xe3069283.
std::uint32_t crc32c(std::string_view bytes, std::uint32_t before = 0);

}  // namespace lockstep::host
