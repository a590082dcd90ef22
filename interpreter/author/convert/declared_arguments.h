// The arguments ${name} of a file in lockstep's language: those that its 'arg' elements declare.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "language/document/document.h"

namespace lockstep::host {

class DeclaredArguments {
 public:
  explicit DeclaredArguments(const Document& document);  // outlives this

  bool is_empty() const { return defaults_.empty(); }
  bool has(std::string_view name) const { return defaults_.contains(name); }
  // A text with the defaults of its arguments that have one: "${n} < 3" as "0 < 3".
  std::string with_defaults(std::string_view text) const;

  // Calls use(offset, name) for each ${name} of a text. $${name} is a text.
  template <class Use>
  static void for_each_in(std::string_view text, Use use) {
    for (auto at = text.find("${"); at != std::string_view::npos; at = text.find("${", at + 2)) {
      const auto close = text.find('}', at);
      if (close == std::string_view::npos) return;
      const bool is_literal = at > 0 && text[at - 1] == '$';
      if (!is_literal) use(at, text.substr(at + 2, close - at - 2));
    }
  }

 private:
  std::unordered_map<std::string_view, const Attribute*> defaults_;  // null: it has none
};

}  // namespace lockstep::host
