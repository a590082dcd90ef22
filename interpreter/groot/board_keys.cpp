#include "groot/board_keys.h"

#include "dialect/btcpp/words.h"

namespace lockstep::host {
namespace {

using Slots = std::map<std::string, std::uint32_t, std::less<>>;

// The key that a parameter of a node is written with; "" if it has none.
std::string_view key_of(const Definition& definition, const DefinitionNode& node,
                        const Parameter& parameter) {
  const std::string_view written = written_value(definition, node, parameter.name);
  if (written.empty()) return parameter.default_key;
  const std::string_view key = btcpp::key_of(written, parameter.name);
  const bool takes_names = parameter.is_key || parameter.names_entry;
  return key.empty() && takes_names ? written : key;
}

// "@key" is one of the main tree, which finds it by itself.
void add(std::string_view key, std::uint32_t entry, Slots& slots) {
  if (!key.empty() && !key.starts_with('@')) slots.emplace(key, entry);
}

void add_script(const Definition& definition, std::uint32_t number, Slots& slots) {
  if (number == Port::kNone || definition.scripts[number].code == nullptr) return;
  const BoundScript& script = definition.scripts[number];
  const auto& names = script.code->names();
  for (std::size_t i = 0; i < names.size(); ++i) add(names[i], script.entries[i], slots);
}

void add_node(const Definition& definition, const DefinitionNode& node, Slots& slots) {
  if (node.hooks != Port::kNone) {
    for (const std::uint32_t it : definition.hooks[node.hooks]) add_script(definition, it, slots);
  }
  if (node.type->category == NodeCategory::SubTree) return;
  for (std::size_t i = 0; i < node.type->parameters.size(); ++i) {
    const Port& port = definition.ports[node.first + i];
    add_script(definition, port.script, slots);
    if (port.entry == Port::kNone) continue;
    add(key_of(definition, node, node.type->parameters[i]), port.entry, slots);
  }
}

}  // namespace

std::vector<GrootBoardKeys> groot_board_keys(const Definition& definition,
                                             std::span<const GrootSubtree> subtrees) {
  std::vector<GrootBoardKeys> boards;
  for (const GrootSubtree& it : subtrees) boards.push_back({it.name(), it.node});
  // The inner trees come first: they say which entries the keys outside are.
  for (std::size_t number = subtrees.size(); number-- > 0;) {
    const GrootSubtree& subtree = subtrees[number];
    Slots& slots = boards[number].slots;
    for_each_node(definition, subtree,
                  [&](std::uint32_t node) { add_node(definition, definition.nodes[node], slots); });
    if (number == 0) break;
    for (const WrittenAttribute& it : definition.attributes(definition.nodes[subtree.node])) {
      const auto inside = slots.find(it.name);
      if (inside == slots.end()) continue;
      add(btcpp::key_of(it.value, it.name), inside->second, boards[subtree.outer].slots);
    }
  }
  for (std::uint32_t entry = 0; entry < definition.entries.size(); ++entry) {
    const std::string& name = definition.entries[entry].name;
    if (name.find('/') == std::string::npos) add(name, entry, boards[0].slots);
  }
  return boards;
}

}  // namespace lockstep::host
