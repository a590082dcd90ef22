// The table behind the frames of a compressed file that says where each begins, so that a reader
// can go to any place of the text: a frame that readers of zstd skip, as in the seekable format of
// zstd (contrib/seekable_format/zstd_seekable_compression_format.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::host {

struct FrameSize {
  std::uint32_t file = 0, text = 0;  // bytes
};

std::string seek_table(std::span<const FrameSize> frames);

constexpr std::size_t kSeekFooter = 9;  // bytes
// The size of the table whose last bytes are these; none: they are not of a table.
std::optional<std::uint64_t> seek_table_size(std::string_view footer);
// None: it is damaged.
std::optional<std::vector<FrameSize>> read_seek_table(std::string_view table);

}  // namespace lockstep::host
