// The names of arguments, keys, ports and leaves.
#pragma once

#include <algorithm>
#include <string_view>

namespace lockstep {

constexpr std::string_view kIdentifierRule = "a letter or '_', then letters, digits or '_'";

// Whether `text` is kIdentifierRule, in ASCII.
constexpr bool is_identifier(std::string_view text) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !text.empty() && is_letter(text[0]) &&
         std::ranges::all_of(text, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

}  // namespace lockstep
