#include "language/document/references.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace lockstep::host {
namespace {

bool is_xml_character(std::uint32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return (code < 0xD800 || code > 0xDFFF) && code != 0xFFFE && code != 0xFFFF && code <= 0x10FFFF;
}

constexpr bool is_in_reference(char c) {
  return c == '#' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::optional<RawUnit> read_number(std::string_view digits, std::size_t raw) {
  const int base = digits.starts_with('x') ? 16 : 10;
  if (base == 16) digits.remove_prefix(1);
  std::uint32_t code = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), code, base);
  if (error != std::errc() || end != digits.data() + digits.size() || !is_xml_character(code))
    return std::nullopt;
  return RawUnit{raw, code < 0x80 ? 1u : code < 0x800 ? 2u : code < 0x10000 ? 3u : 4u};
}

RawUnit read_unit(std::string_view raw) {
  if (raw[0] == '&') return read_reference(raw).value_or(RawUnit{1, 1});
  // The reader turns each line end, of any of the two-byte kinds too, into one newline.
  if (raw.starts_with("\r\n") || raw.starts_with("\n\r")) return {2, 1};
  return {1, 1};
}

}  // namespace

std::optional<RawUnit> read_reference(std::string_view raw) {
  // Zeros may lead a number, so it may be long.
  std::size_t end = 1;
  while (end < raw.size() && is_in_reference(raw[end])) ++end;
  if (!raw.substr(end).starts_with(';')) return std::nullopt;
  const auto name = raw.substr(1, end - 1);
  if (name.starts_with('#')) return read_number(name.substr(1), end + 1);
  constexpr std::string_view kNames[] = {"lt", "gt", "amp", "quot", "apos"};
  if (std::find(std::begin(kNames), std::end(kNames), name) == std::end(kNames))
    return std::nullopt;
  return RawUnit{end + 1, 1};
}

std::size_t raw_offset(std::string_view raw, std::size_t read) {
  std::size_t offset = 0;
  for (std::size_t done = 0; done < read && offset < raw.size();) {
    const auto unit = read_unit(raw.substr(offset));
    if (done + unit.read > read) break;
    offset += unit.raw;
    done += unit.read;
  }
  return offset;
}

}  // namespace lockstep::host
