#include "author/server/positions.h"

#include <algorithm>

namespace lockstep::host {
namespace {

constexpr std::size_t kBlock = 512;

// A character beyond U+FFFF takes four bytes in UTF-8 and two units in UTF-16.
std::size_t units_of(char first_byte) {
  const auto byte = static_cast<unsigned char>(first_byte);
  if ((byte & 0xC0u) == 0x80) return 0;  // not the first
  return byte >= 0xF0 ? 2 : 1;
}

std::size_t units_of(std::string_view text) {
  std::size_t units = 0;
  for (const char byte : text) units += units_of(byte);
  return units;
}

}  // namespace

Positions::Positions(std::string_view text) : text_(text), starts_{0} {
  const char* const begin = text.data();
  std::size_t longest = 0;
  const bool has_old_ends = text.find('\r') != text.npos;
  for (std::size_t at = 0; at < text.size(); ++at) {
    at = has_old_ends ? text.find_first_of("\r\n", at) : text.find('\n', at);
    if (at == text.npos) break;
    if (begin[at] == '\r' && at + 1 < text.size() && begin[at + 1] == '\n') ++at;
    longest = std::max(longest, at + 1 - starts_.back());
    starts_.push_back(at + 1);
  }
  longest = std::max(longest, text.size() - starts_.back());
  if (longest <= kBlock) return;
  units_ = {0};
  units_.reserve(text.size() / kBlock + 2);
  for (std::size_t at = 0; at < text.size(); at += kBlock)
    units_.push_back(units_.back() + units_of(text.substr(at, kBlock)));
}

std::string_view Positions::line(std::size_t number) const {
  const std::size_t begin = starts_[number];
  const std::size_t end = number + 1 < starts_.size() ? starts_[number + 1] : text_.size();
  std::string_view line = text_.substr(begin, end - begin);
  while (number + 1 < starts_.size() && (line.ends_with('\n') || line.ends_with('\r')))
    line.remove_suffix(1);
  return line;
}

std::size_t Positions::byte_at(Position position) const {
  if (position.line >= starts_.size()) return text_.size();
  const std::string_view line = this->line(position.line);
  const std::size_t start = starts_[position.line];
  std::size_t byte = 0;
  std::uint64_t units = 0;
  if (line.size() > kBlock) {  // to the last block that is not beyond the position
    const std::size_t before = units_between(0, start);
    const std::uint64_t goal = std::min<std::uint64_t>(position.character, line.size()) + before;
    const auto after = std::ranges::upper_bound(units_, goal);
    const auto block = static_cast<std::size_t>(after - units_.begin()) - 1;
    if (block * kBlock > start) {
      byte = std::min(block * kBlock - start, line.size());
      units = units_between(start, start + byte);
    }
  }
  for (; byte < line.size(); ++byte) {
    const std::size_t next = units_of(line[byte]);
    if (next > 0 && units + next > position.character) break;
    units += next;
  }
  return start + byte;
}

std::size_t Positions::units_between(std::size_t begin, std::size_t end) const {
  if (end - begin <= kBlock) return units_of(text_.substr(begin, end - begin));
  const auto before = [&](std::size_t byte) {
    const std::size_t block = byte / kBlock;
    return units_[block] + units_of(text_.substr(block * kBlock, byte - block * kBlock));
  };
  return before(end) - before(begin);
}

Position Positions::position_of(std::size_t byte) const {
  byte = std::min(byte, text_.size());
  const auto after = std::ranges::upper_bound(starts_, byte);
  const auto number = static_cast<std::size_t>(after - starts_.begin()) - 1;
  return {number, units_between(starts_[number], byte)};
}

Json Positions::json(std::size_t byte) const {
  const Position it = position_of(byte);
  return {{"line", it.line}, {"character", it.character}};
}

Json Positions::json(ByteRange range) const {
  return {{"start", json(range.begin)}, {"end", json(range.end)}};
}

}  // namespace lockstep::host
