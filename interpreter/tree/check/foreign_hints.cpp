#include "tree/check/foreign_hints.h"

#include <utility>

#include "base/core/language.h"
#include "tree/language_reader.h"

namespace lockstep::host {
namespace {

// The first answer that is not empty.
template <class Ask>
auto ask_languages(Ask ask) {
  decltype(ask(std::declval<const ForeignHints&>())) answer;
  for (const LanguageRules* it : languages()) {
    if (answer.empty() && it->reader->hints != nullptr) answer = ask(*it->reader->hints);
  }
  return answer;
}

}  // namespace

std::string foreign_node_hint(std::string_view tag, std::span<const Attribute> attributes) {
  return ask_languages([&](const ForeignHints& it) { return it.for_node(tag, attributes); });
}

std::string hint_of_plugin(std::string_view tag) {
  return ask_languages([&](const ForeignHints& it) { return it.of_plugin(tag); });
}

std::string foreign_attribute_hint(std::string_view tag, const Attribute& attribute) {
  return ask_languages([&](const ForeignHints& it) { return it.for_attribute(tag, attribute); });
}

std::string_view foreign_attribute_name(std::string_view tag, std::string_view attribute) {
  return ask_languages([&](const ForeignHints& it) { return it.our_name(tag, attribute); });
}

}  // namespace lockstep::host
