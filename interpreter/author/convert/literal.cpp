#include "author/convert/literal.h"

#include <fmt/format.h>

namespace lockstep::host {
namespace {

// "" if it has both quotation marks.
std::string quoted_literal(std::string_view text) {
  if (text.find('\'') == std::string_view::npos) return fmt::format("'{}'", text);
  return text.find('"') == std::string_view::npos ? fmt::format("\"{}\"", text) : std::string();
}

}  // namespace

std::string literal_of(std::string_view text, std::optional<ValueType> type) {
  // Of a Number, an int if the text is one.
  for (const ValueType it : {ValueType::Bool, ValueType::Int, ValueType::Double}) {
    const bool is_number = it != ValueType::Bool;
    const bool is_meant = type == it || (is_number && type == ValueType::Number);
    const auto value = !type || is_meant ? parse_value(it, text) : std::nullopt;
    if (value && (is_meant || to_text(*value) == text)) return to_text(*value);
    if (value && it == ValueType::Int) break;  // "-0" is no double
  }
  return quoted_literal(text);
}

}  // namespace lockstep::host
