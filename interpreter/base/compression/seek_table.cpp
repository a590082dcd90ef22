#include "base/compression/seek_table.h"

namespace lockstep::host {
namespace {

constexpr std::uint32_t kSkippable = 0x184D2A5E, kSeekable = 0x8F92EAB1;
constexpr std::size_t kHeader = 8, kRow = 8, kRowWithSum = 12;
constexpr unsigned kHasSums = 0x80, kReserved = 0x7C;

void add(std::string& bytes, std::uint32_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift);
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (unsigned i = 0; i < 4; ++i) {
    number |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  }
  return number;
}

std::size_t row_size(std::string_view footer) {
  return (static_cast<unsigned char>(footer[4]) & kHasSums) != 0 ? kRowWithSum : kRow;
}

}  // namespace

std::string seek_table(std::span<const FrameSize> frames) {
  std::string bytes;
  add(bytes, kSkippable);
  add(bytes, static_cast<std::uint32_t>(kRow * frames.size() + kSeekFooter));
  for (const FrameSize& it : frames) {
    add(bytes, it.file);
    add(bytes, it.text);
  }
  add(bytes, static_cast<std::uint32_t>(frames.size()));
  bytes += '\0';
  add(bytes, kSeekable);
  return bytes;
}

std::optional<std::uint64_t> seek_table_size(std::string_view footer) {
  if (footer.size() != kSeekFooter || number_at(footer, 5) != kSeekable) return std::nullopt;
  if ((static_cast<unsigned char>(footer[4]) & kReserved) != 0) return std::nullopt;
  return kHeader + std::uint64_t{number_at(footer, 0)} * row_size(footer) + kSeekFooter;
}

std::optional<std::vector<FrameSize>> read_seek_table(std::string_view table) {
  if (table.size() < kHeader + kSeekFooter) return std::nullopt;
  const std::string_view footer = table.substr(table.size() - kSeekFooter);
  if (seek_table_size(footer) != table.size()) return std::nullopt;
  if (number_at(table, 0) != kSkippable) return std::nullopt;
  if (number_at(table, 4) != table.size() - kHeader) return std::nullopt;
  std::vector<FrameSize> frames(number_at(footer, 0));
  std::size_t at = kHeader;
  for (FrameSize& it : frames) {
    it = {number_at(table, at), number_at(table, at + 4)};
    at += row_size(footer);
  }
  return frames;
}

}  // namespace lockstep::host
