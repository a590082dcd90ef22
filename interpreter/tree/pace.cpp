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

void mark_slowed(Definition& definition) {
  std::vector<bool> gives(definition.nodes.size());  // factors to what is below
  for (std::size_t node = 0; node < gives.size(); ++node) {
    gives[node] = paces(definition, definition.nodes[node]);
  }
  for (const DefinitionGroup& group : definition.groups) {
    if (!gives[group.node]) continue;
    for (const std::uint32_t member : group.members) gives[member] = true;
  }
  for (std::uint32_t node = 1; node < definition.nodes[0].end; ++node) {
    const std::uint32_t parent = definition.nodes[node].parent;
    gives[node] = gives[node] || gives[parent];
    // A stand-in may be slowed on the robot.
    const NodeType& type = *definition.nodes[node].type;
    definition.nodes[node].is_slowed =
        gives[parent] && (type.leaf == nullptr || type.can_be_slowed || type.mock != nullptr);
  }
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
