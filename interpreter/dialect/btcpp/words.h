// The words of documents for BehaviorTree.CPP: marks, and what the value of an attribute means.
#pragma once

#include <string_view>

#include "base/core/identifier.h"

namespace lockstep::host::btcpp {

// Editors write these. They have no meaning here.
inline constexpr std::string_view kMarks[] = {"_uid",       "_fullpath", "_collapsed",  "_favorite",
                                              "_hardcoded", "_external", "_subtreeOnly"};

// The key of the entry that the value of the port `port` names; "" when it is a literal.
constexpr std::string_view key_of(std::string_view value, std::string_view port) {
  const std::string_view text = without_blanks_around(value);
  if (text == "=" || text == "{=}") return port;
  const bool braced = text.size() > 2 && text.front() == '{' && text.back() == '}';
  return braced ? text.substr(1, text.size() - 2) : std::string_view();
}

}  // namespace lockstep::host::btcpp
