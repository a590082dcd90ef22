#include "author/convert/literal.h"

#include <fmt/format.h>

#include <cmath>

#include "base/core/value.h"

namespace lockstep::host {

std::string literal_of(std::string_view text) {
  if (text == "true" || text == "false") return std::string(text);
  if (const auto whole = parse_int(text)) return to_text(Value(*whole));
  if (const auto number = parse_double(text); number && std::isfinite(*number)) {
    return to_text(Value(*number));
  }
  return quoted_literal(text);
}

std::string quoted_literal(std::string_view text) {
  if (text.find('\'') == std::string_view::npos) return fmt::format("'{}'", text);
  return text.find('"') == std::string_view::npos ? fmt::format("\"{}\"", text) : std::string();
}

}  // namespace lockstep::host
