#include "language/document/byte_range.h"

#include <algorithm>
#include <optional>

#include "language/document/cursor.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kLineEnds = "\r\n";

bool begins_line_end(std::string_view rest) {
  return rest.empty() || kLineEnds.find(rest.front()) != kLineEnds.npos;
}

// The closing quote of a value that begins at `begin`, unless its line ends before.
std::optional<std::size_t> closing_quote(std::string_view text, std::size_t begin) {
  const char quote = begin == 0 ? ' ' : text[begin - 1];
  if (quote != '"' && quote != '\'') return std::nullopt;
  const char stops[] = {quote, kLineEnds[0], kLineEnds[1]};
  const auto end = text.find_first_of(std::string_view(stops, sizeof stops), begin);
  if (end == text.npos || text[end] != quote || end == begin) return std::nullopt;
  return end;
}

// The end of what begins at `begin`, at least one character of the line. It reads no further than
// that, since a whole text may be one line, and each of its messages asks.
std::size_t end_of(std::string_view text, std::size_t begin) {
  const std::string_view rest = text.substr(begin);
  if (begins_line_end(rest)) return begin;
  if (const auto quote = closing_quote(text, begin)) return *quote;
  const std::size_t sign = rest.starts_with("</") ? 2 : rest.starts_with('<') ? 1 : 0;
  Cursor cursor(rest);
  cursor.go_to(sign);
  const std::size_t name = cursor.take_name().size();
  if (sign + name > 0) return begin + sign + name;
  std::size_t length = 1;
  while (length < rest.size() && (static_cast<unsigned char>(rest[length]) & 0xC0u) == 0x80)
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
