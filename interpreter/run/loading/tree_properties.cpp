#include "run/loading/tree_properties.h"

#include <string>
#include <utility>

#include "base/core/parameter_value.h"
#include "tree/paths.h"

namespace lockstep::host {
namespace {

PropertyNames property_names(const Definition& definition) {
  PropertyNames names{.paths = paths_of(definition), .entries = {}};
  names.ends = PathEnds(names.paths);
  for (const BlackboardEntry& it : definition.entries) {
    names.entries.push_back(
        {it.name, std::string(type_name(it.type, it.object)), it.typing == Typing::Strict});
  }
  return names;
}

}  // namespace

std::vector<Property> tree_properties(const Definition& definition, const Reporter& report) {
  std::vector<Property> properties;
  if (definition.properties.empty()) return properties;
  const PropertyNames names = property_names(definition);
  for (const WrittenProperty& it : definition.properties) {
    auto property = Property::parse(it.text, names);
    if (!property) {
      const PropertyError& error = property.error();
      report.in_value("bad-property"_code, it.place, error.offset, error.message, error.hint);
      continue;
    }
    property->set_name(std::string(it.name));
    properties.push_back(std::move(*property));
  }
  return properties;
}

}  // namespace lockstep::host
