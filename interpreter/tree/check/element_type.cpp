#include "tree/check/element_type.h"

#include <optional>

#include "base/core/element_types.h"

namespace lockstep::host {
const NodeType* type_of_element(const NodeElement& element, const NodeType& type,
                                const Reporter& report) {
  if (type.element_types == nullptr) return &type;
  const auto given = [&](std::string_view name) -> std::optional<std::string_view> {
    const Attribute* const attribute = find_attribute(element.attributes, name);
    if (attribute == nullptr) return std::nullopt;
    return attribute->value;
  };
  const auto fixed = fixed_texts(type, given);
  if (!fixed) return &type;
  const auto found = type.element_types->type_of(*fixed);
  if (found) return *found;
  const auto& [parameter, why] = found.error();
  const Attribute* const blamed = find_attribute(element.attributes, parameter);
  if (blamed != nullptr) {
    report.at_value("bad-type"_code, blamed->place, why.message, why.hint);
  } else {
    report.at("bad-type"_code, element.place, why.message, why.hint);
  }
  return nullptr;
}

}  // namespace lockstep::host
