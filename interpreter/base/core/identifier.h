// The names of arguments, keys, ports and leaves, and the blanks around them.
#pragma once

#include <algorithm>
#include <string_view>

namespace lockstep::host {

constexpr std::string_view kIdentifierRule = "a letter or '_', then letters, digits or '_'";

constexpr std::string_view without_blanks_around(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// Whether `text` is kIdentifierRule, in ASCII.
constexpr bool is_identifier(std::string_view text) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !text.empty() && is_letter(text[0]) &&
         std::ranges::all_of(text, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

// Whether `name` may be that of a port of any plugin. No mark of editors is: they begin with '_'.
constexpr bool is_port_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  constexpr std::string_view kForbidden = " \t\r\n<>&\"'/\\:*?|.";
  return !name.empty() && is_letter(name[0]) && std::ranges::none_of(name, [&](char c) {
    return kForbidden.find(c) != std::string_view::npos || static_cast<unsigned char>(c) < 0x20 ||
           c == 0x7f;
  });
}

}  // namespace lockstep::host
