#include "tree/mend/element_type.h"

#include <algorithm>
#include <optional>

#include "base/core/element_types.h"

namespace lockstep::host {
namespace {

// The type of this element, where elements of `type` differ and this one says enough.
const NodeType* described(const TolerantTree& tree, const TolerantElement& element,
                          const NodeType& type) {
  if (type.element_types == nullptr) return &type;
  const auto given = [&](std::string_view name) -> std::optional<std::string_view> {
    const std::string_view text = tree.value_of(element, name);
    if (text.empty()) return std::nullopt;
    return text;
  };
  const auto fixed = fixed_texts(type, given);
  if (!fixed) return &type;
  return type.element_types->type_of(*fixed).value_or(&type);
}

}  // namespace

const NodeType* type_of(const TolerantTree& tree, const TolerantElement& element,
                        const Catalog& catalog) {
  if (const NodeType* type = catalog.find(element.tag)) return described(tree, element, *type);
  constexpr std::string_view kExplicit[] = {"Action", "Condition", "Control", "Decorator"};
  if (std::ranges::count(kExplicit, element.tag) == 0) return nullptr;
  const NodeType* const type = catalog.find(tree.value_of(element, "ID"));
  return type == nullptr ? nullptr : described(tree, element, *type);
}

const Parameter* parameter_of(const NodeType* type, std::string_view attribute) {
  if (type == nullptr) return nullptr;
  const auto it = std::ranges::find(type->parameters, attribute, &Parameter::name);
  return it == type->parameters.end() ? nullptr : &*it;
}

}  // namespace lockstep::host
