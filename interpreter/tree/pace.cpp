#include "tree/pace.h"

#include <algorithm>

#include "base/core/synchronization.h"

namespace lockstep::host {

bool paces(const Definition& definition, const DefinitionNode& node) {
  if (!compares_progress(definition.synchronization(node))) return false;
  const Value* pace = definition.constant(node, "pace");
  return pace != nullptr && *pace == Value(true);
}

bool paces(const Definition& definition) {
  return std::ranges::any_of(definition.nodes,
                             [&](const DefinitionNode& node) { return paces(definition, node); });
}

void ignore_pace(Definition& definition) {
  const auto no = static_cast<std::uint32_t>(definition.values.size());
  for (const DefinitionNode& node : definition.nodes) {
    if (!paces(definition, node)) continue;
    const auto& parameters = node.type->parameters;
    const auto place = std::ranges::find(parameters, "pace", &Parameter::name);
    if (definition.values.size() == no) definition.values.emplace_back(false);
    definition.ports[node.first + static_cast<std::size_t>(place - parameters.begin())].value = no;
  }
}

}  // namespace lockstep::host
