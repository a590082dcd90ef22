#include "authoring/server/positions.h"

#include <algorithm>

namespace lockstep::host {
namespace {

// A character beyond U+FFFF takes four bytes in UTF-8 and two units in UTF-16.
std::size_t units_of(char first_byte) {
  const auto byte = static_cast<unsigned char>(first_byte);
  if ((byte & 0xC0u) == 0x80) return 0;  // not the first
  return byte >= 0xF0 ? 2 : 1;
}

}  // namespace

Positions::Positions(std::string_view text) : text_(text), starts_{0} {
  const char* const begin = text.data();
  const bool has_old_ends = text.find('\r') != text.npos;
  for (std::size_t at = 0; at < text.size(); ++at) {
    at = has_old_ends ? text.find_first_of("\r\n", at) : text.find('\n', at);
    if (at == text.npos) break;
    if (begin[at] == '\r' && at + 1 < text.size() && begin[at + 1] == '\n') ++at;
    starts_.push_back(at + 1);
  }
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
  std::size_t byte = 0;
  for (std::uint64_t units = 0; byte < line.size(); ++byte) {
    const std::size_t next = units_of(line[byte]);
    if (next > 0 && units + next > position.character) break;
    units += next;
  }
  return starts_[position.line] + byte;
}

Position Positions::position_of(std::size_t byte) const {
  byte = std::min(byte, text_.size());
  const auto after = std::ranges::upper_bound(starts_, byte);
  const auto number = static_cast<std::size_t>(after - starts_.begin()) - 1;
  Position position{number, 0};
  for (std::size_t at = starts_[number]; at < byte; ++at) position.character += units_of(text_[at]);
  return position;
}

Json Positions::json(std::size_t byte) const {
  const Position it = position_of(byte);
  return {{"line", it.line}, {"character", it.character}};
}

Json Positions::json(ByteRange range) const {
  return {{"start", json(range.begin)}, {"end", json(range.end)}};
}

}  // namespace lockstep::host
