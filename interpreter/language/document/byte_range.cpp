#include "language/document/byte_range.h"

#include <algorithm>

#include "language/document/cursor.h"

namespace lockstep::host {
namespace {

// The end of what begins at `begin`, at least one character of the line.
std::size_t end_of(std::string_view text, std::size_t begin) {
  const std::string_view rest = text.substr(begin);
  const std::string_view line = rest.substr(0, std::min(rest.find_first_of("\r\n"), rest.size()));
  if (line.empty()) return begin;
  const char before = begin == 0 ? ' ' : text[begin - 1];
  if (before == '"' || before == '\'') {
    const auto quote = line.find(before);
    if (quote != line.npos && quote > 0) return begin + quote;
  }
  const std::size_t sign = line.starts_with("</") ? 2 : line.starts_with('<') ? 1 : 0;
  Cursor cursor(line);
  cursor.go_to(sign);
  const std::size_t name = cursor.take_name().size();
  if (sign + name > 0) return begin + sign + name;
  std::size_t length = 1;
  while (length < line.size() && (static_cast<unsigned char>(line[length]) & 0xC0u) == 0x80)
    ++length;
  return begin + length;
}

}  // namespace

ByteRange range_of(std::string_view text, const LineIndex& lines, const SourceLocation& place) {
  if (place.line == 0) return {0, 0};
  const std::string_view line = lines.line(place.line);
  if (line.data() == nullptr) return {text.size(), text.size()};
  const auto start = static_cast<std::size_t>(line.data() - text.data());
  const std::size_t begin =
      std::min<std::size_t>(start + (place.column == 0 ? 0 : place.column - 1), text.size());
  return {begin, end_of(text, begin)};
}

}  // namespace lockstep::host
