#include "language/document/value_text.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <vector>

#include "language/document/references.h"

namespace lockstep::host {
namespace {

void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  const auto put_rest = [&](int bits) {
    for (; bits >= 0; bits -= 6) put(0x80u | ((code >> static_cast<unsigned>(bits)) & 0x3Fu));
  };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0u | (code >> 6u));
    put_rest(0);
  } else if (code < 0x10000) {
    put(0xE0u | (code >> 12u));
    put_rest(6);
  } else {
    put(0xF0u | (code >> 18u));
    put_rest(12);
  }
}

// The name or number between '&' and ';'.
void append_reference(std::string& text, std::string_view name) {
  if (name == "lt") {
    text += '<';
  } else if (name == "gt") {
    text += '>';
  } else if (name == "amp") {
    text += '&';
  } else if (name == "quot") {
    text += '"';
  } else if (name == "apos") {
    text += '\'';
  } else {
    const bool is_hex = name.starts_with("#x");
    const std::string_view digits = name.substr(is_hex ? 2 : 1);
    std::uint32_t code = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), code, is_hex ? 16 : 10);
    append_utf8(text, code);
  }
}

struct Unit {
  std::size_t raw;   // bytes in the text
  std::string read;  // what they mean
};

Unit first_unit(std::string_view raw) {
  if (raw[0] == '&') {
    if (const auto reference = read_reference(raw)) {
      Unit unit{reference->raw, {}};
      append_reference(unit.read, raw.substr(1, reference->raw - 2));
      return unit;
    }
  }
  if (raw.starts_with("\r\n") || raw.starts_with("\n\r")) return {2, "\n"};
  if (raw[0] == '\r') return {1, "\n"};
  return {1, std::string(1, raw[0])};
}

std::vector<Unit> units_of(std::string_view raw) {
  std::vector<Unit> units;
  for (; !raw.empty(); raw.remove_prefix(units.back().raw)) units.push_back(first_unit(raw));
  return units;
}

// The value that a reader makes of it: references and line ends are replaced.
std::string unescaped(std::string_view raw) {
  std::string text;
  while (!raw.empty()) {
    const Unit unit = first_unit(raw);
    text += unit.read;
    raw.remove_prefix(unit.raw);
  }
  return text;
}

}  // namespace

std::string escaped(std::string_view value, char quote) {
  std::string text;
  for (const char c : value) {
    if (c == '<') {
      text += "&lt;";
    } else if (c == '&') {
      text += "&amp;";
    } else if (c == '\n') {
      text += "&#10;";
    } else if (c == '\r') {
      text += "&#13;";
    } else if (c == quote) {
      text += quote == '"' ? "&quot;" : "&apos;";
    } else {
      text += c;
    }
  }
  return text;
}

std::string quoted(std::string_view value) {
  return '"' + escaped(value) + '"';
}

std::string changed_value(std::string_view raw, std::string_view value, char quote) {
  const std::vector<Unit> units = units_of(raw);
  std::size_t first = 0, front = 0, front_raw = 0;
  while (first < units.size() && value.substr(front).starts_with(units[first].read)) {
    front += units[first].read.size();
    front_raw += units[first++].raw;
  }
  std::size_t last = units.size(), back = value.size(), back_raw = raw.size();
  while (last > first && value.substr(front, back - front).ends_with(units[last - 1].read)) {
    back -= units[--last].read.size();
    back_raw -= units[last].raw;
  }
  auto text = std::string(raw.substr(0, front_raw))
                  .append(escaped(value.substr(front, back - front), quote))
                  .append(raw.substr(back_raw));
  // Two parts may read as one: a '\r' and a '\n' as a line end.
  return unescaped(text) == value ? text : escaped(value, quote);
}

}  // namespace lockstep::host
