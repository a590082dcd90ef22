// The words of documents for BehaviorTree.CPP: what an attribute is by its name, and what its value
// means.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>

#include "core/language.h"
#include "dialect/btcpp/rules.h"

namespace lockstep::btcpp {

inline std::optional<Hook> hook_of(std::string_view attribute) {
  return hook_named(attribute, kRules);
}

// Whether an attribute of that name is a port; all others only mark the node for editors.
constexpr bool is_port_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  constexpr std::string_view kForbidden = " \t\r\n<>&\"'/\\:*?|.";
  return !name.empty() && is_letter(name[0]) && std::ranges::none_of(name, [&](char c) {
    return kForbidden.find(c) != std::string_view::npos || static_cast<unsigned char>(c) < 0x20 ||
           c == 0x7f;
  });
}

constexpr std::string_view without_blanks_around(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// The key of the entry that the value of the port `port` names; "" when it is a literal.
constexpr std::string_view key_of(std::string_view value, std::string_view port) {
  const std::string_view text = without_blanks_around(value);
  if (text == "=" || text == "{=}") return port;
  const bool braced = text.size() > 2 && text.front() == '{' && text.back() == '}';
  return braced ? text.substr(1, text.size() - 2) : std::string_view();
}

}  // namespace lockstep::btcpp
