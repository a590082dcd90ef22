#include "run/loading/tree_properties.h"

#include <optional>
#include <string>
#include <utility>

#include "base/core/pre_order.h"
#include "engine/compile.h"
#include "judge/measure/live_properties.h"
#include "language/document/reporter.h"

namespace lockstep::host {

std::vector<Property> tree_properties(const Project& project, const Definition& definition,
                                      Diagnostics& diagnostics) {
  std::vector<Property> properties;
  std::optional<PropertyNames> names;  // made for the first
  const Reporter report(project.sources, diagnostics);
  const Document& document = *project.documents.front();
  const auto elements = document.elements();
  for (const std::uint32_t child : children_in(elements, 0)) {
    if (elements[child].tag != "property") continue;
    const Attribute* const text = document.find_attribute(child, "");
    const Attribute* const name = document.find_attribute(child, "name");
    if (text == nullptr || name == nullptr) continue;  // another language
    if (!names) names = property_names(shape_of(compile(definition)));
    auto property = Property::parse(text->value, *names);
    if (!property) {
      const PropertyError& error = property.error();
      report.in_value(text->place, error.offset, error.message, error.hint);
      continue;
    }
    property->set_name(std::string(name->value));
    properties.push_back(std::move(*property));
  }
  return properties;
}

}  // namespace lockstep::host
