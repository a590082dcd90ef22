#include "author/convert/scripts.h"

#include <algorithm>

#include "tree/check/node_check.h"

namespace lockstep::host {
namespace {

const Parameter* parameter_of(const NodeType* type, std::string_view name) {
  if (type == nullptr) return nullptr;
  const auto found = std::ranges::find(type->parameters, name, &Parameter::name);
  return found == type->parameters.end() ? nullptr : &*found;
}

}  // namespace

const NodeType* type_at(const Document& document, std::uint32_t element, const Catalog& nodes) {
  const std::string_view tag = document.elements()[element].tag;
  const Attribute* id = is_explicit_tag(tag) ? document.find_attribute(element, "ID") : nullptr;
  return nodes.find(id == nullptr ? tag : id->value);
}

bool is_script_at(std::string_view attribute, const NodeType* type, const LanguageRules& rules) {
  const Parameter* const it = parameter_of(type, attribute);
  return (it != nullptr && it->is_script && !it->is_template) || hook_named(attribute, rules);
}

bool is_entry_at(std::string_view attribute, const NodeType* type) {
  const Parameter* const it = parameter_of(type, attribute);
  return it != nullptr && (it->is_key || it->names_entry);
}

}  // namespace lockstep::host
