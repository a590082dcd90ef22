#include "author/convert/number_names.h"

#include <algorithm>

#include "author/convert/scripts.h"
#include "base/core/identifier.h"
#include "dialect/btcpp/words.h"
#include "language/expression/token.h"

namespace lockstep::host {
namespace {

constexpr bool is_assignment(Symbol symbol) {
  return symbol >= Symbol::Make && symbol <= Symbol::DivideBy;
}

}  // namespace

bool is_in_upper_case(std::string_view name) {
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  const auto fits = [&](char c) { return is_capital(c) || c == '_' || (c >= '0' && c <= '9'); };
  return is_identifier(name) && std::ranges::any_of(name, is_capital) &&
         std::ranges::all_of(name, fits);
}

NumberNames::NumberNames(const Document& document, const Conversion& conversion) {
  find_entries(document, conversion);
  if (conversion.project == nullptr) return;
  for (const auto& it : conversion.project->documents) find_entries(*it, conversion);
}

void NumberNames::find_entries(const Document& document, const Conversion& conversion) {
  const auto elements = document.elements();
  for (std::uint32_t element = 0; element < elements.size(); ++element) {
    const std::string_view tag = elements[element].tag;
    const NodeType* const type = type_at(document, element, conversion.from_nodes);
    // The ports of models, too.
    const bool is_subtree = tag.starts_with("SubTree");
    const bool is_port = tag.ends_with("_port");
    for (const Attribute& it : document.attributes(element)) {
      if (is_script_at(it.name, type, conversion.from)) find_assigned(it.value);
      if (is_entry_at(it.name, type) || (is_port && it.name == "name")) add(it.value);
      if (is_subtree || !btcpp::key_of(it.value, it.name).empty()) add(it.name);
      find_keys(it.value);
    }
  }
}

// Also with ':=' in an expression: a := B := 1.
void NumberNames::find_assigned(std::string_view script) {
  TokenReader reader;
  std::string_view name;  // if the last token was one
  for (std::size_t offset = 0;;) {
    const auto token = reader.next(script, offset);
    if (!token || token->symbol == Symbol::End) return;
    if (is_assignment(token->symbol)) add(name);
    name = token->symbol == Symbol::Name ? token->text : std::string_view();
  }
}

void NumberNames::find_keys(std::string_view text) {
  for (auto at = text.find('{'); at != text.npos; at = text.find('{', at + 1))
    add(text.substr(at + 1, text.find('}', at) - at - 1));
}

// "@KEY" is the entry of the main tree.
void NumberNames::add(std::string_view name) {
  if (name.starts_with('@')) name.remove_prefix(1);
  if (is_in_upper_case(name)) entries_.emplace(name);
}

}  // namespace lockstep::host
