#include "author/convert/entry_types.h"

#include <fmt/format.h>

#include <algorithm>

#include "tree/types/script_types.h"

namespace lockstep::host {

EntryTypes::EntryTypes(const Definition* definition) : definition_(definition) {
  if (definition == nullptr) return;
  entries_.resize(definition->entries.size());
  for (std::uint32_t i = 0; i < entries_.size(); ++i) {
    const BlackboardEntry& it = definition->entries[i];
    const bool is_declared =
        definition->rules->strict_types && it.is_present && it.typing != Typing::Any;
    if (is_declared) entries_[i].declared = it.type;
    names_.emplace(it.name, i);
  }
  for (std::uint32_t i = 0; i < definition->nodes.size(); ++i) {
    nodes_.emplace(definition->nodes[i].place.byte, i);
    see_ports(definition->nodes[i]);
  }
  for (const BoundScript& script : definition->scripts) see_script(script);
}

// Of a language, not a node of a plugin that has such a name, as SwitchLight.
bool EntryTypes::is_switch(const NodeType& type) {
  return type.mock == nullptr && type.id.starts_with("Switch");
}

void EntryTypes::add(std::optional<ValueType>& seen, bool& differ, ValueType type) {
  differ |= seen && seen != type;
  seen = type;
}

void EntryTypes::see_ports(const DefinitionNode& node) {
  if (node.type->category == NodeCategory::SubTree) return;
  // What a Switch compares may have any type.
  if (is_switch(*node.type)) return see_switch(definition_->ports[node.first]);
  for (std::size_t i = 0; i < node.type->parameters.size(); ++i) {
    const Parameter& parameter = node.type->parameters[i];
    const Port& port = definition_->ports[node.first + i];
    if (port.entry == Port::kNone || parameter.is_key) continue;
    Seen& seen = entries_[port.entry];
    seen.is_open |= parameter.is_generic && node.type->mock != nullptr;
    if (!parameter.is_generic) add(seen.port, seen.ports_differ, parameter.type);
  }
}

void EntryTypes::see_switch(const Port& port) {
  if (port.script == Port::kNone) return;
  for (const std::uint32_t entry : definition_->scripts[port.script].entries)
    ++entries_[entry].switches;
}

void EntryTypes::see_script(const BoundScript& script) {
  for (const std::uint32_t entry : script.entries) ++entries_[entry].scripts;
  if (script.code == nullptr) return;
  std::vector<StaticType> types;
  for (const std::uint32_t entry : script.entries) types.push_back({found(entries_[entry]).type});
  const auto assigned = [&](std::uint32_t name, const StaticType& type) {
    Seen& seen = entries_[script.entries[name]];
    if (!type.type) return;
    add(seen.script, seen.scripts_differ, *type.type);
    seen.has_number |= type.type != ValueType::String;
  };
  infer_types(*script.code, types, {.assigned = assigned, .wrong = [](auto&&...) {}});
}

EntryTypes::Found EntryTypes::found(const Seen& seen) {
  Found found{.has_port = seen.port.has_value(),
              .has_script = seen.scripts > seen.switches,
              .has_switch = seen.switches > 0,
              .is_open = seen.is_open,
              .has_number = seen.has_number};
  if (seen.port) {
    if (!seen.ports_differ) found.type = seen.port;
  } else if (seen.declared && (!seen.is_open || seen.script)) {
    found.type = seen.declared;
  } else if (!seen.scripts_differ) {
    found.type = seen.script;
  }
  return found;
}

EntryTypes::Found EntryTypes::common(Found one, const Found& other) {
  if (one.type != other.type) one.type.reset();
  one.has_port |= other.has_port;
  one.has_script |= other.has_script;
  one.has_switch |= other.has_switch;
  one.is_open |= other.is_open;
  one.has_number |= other.has_number;
  return one;
}

std::optional<ValueType> EntryTypes::value_of(const BoundScript& script) const {
  if (script.code == nullptr) return std::nullopt;
  std::vector<StaticType> types;
  for (const std::uint32_t entry : script.entries) types.push_back({found(entries_[entry]).type});
  return infer_types(*script.code, types, {.assigned = [](auto&&...) {}, .wrong = [](auto&&...) {}})
      .type;
}

EntryTypes::Found EntryTypes::of(Place node, std::string_view parameter) const {
  std::optional<Found> all;
  const auto [begin, end] = nodes_.equal_range(node.byte);
  for (auto it = begin; it != end; ++it) {
    const DefinitionNode& at = definition_->nodes[it->second];
    const auto parameters = at.type->parameters;
    const auto place = std::ranges::find(parameters, parameter, &Parameter::name);
    if (place == parameters.end()) continue;
    const auto index = static_cast<std::size_t>(place - parameters.begin());
    const Port& port = definition_->ports[at.first + index];
    Found here;
    if (port.script != Port::kNone) here.type = value_of(definition_->scripts[port.script]);
    if (port.entry != Port::kNone) here = found(entries_[port.entry]);
    all = all ? common(*all, here) : here;
  }
  return all.value_or(Found());
}

// The names of the SubTrees around, as the names of entries begin.
std::string EntryTypes::path_of(std::uint32_t subtree) const {
  const auto& nodes = definition_->nodes;
  std::string path(nodes[subtree].name);
  for (std::uint32_t node = subtree; nodes[node].parent != node;) {
    node = nodes[node].parent;
    if (nodes[node].type->category == NodeCategory::SubTree)
      path.insert(0, fmt::format("{}/", nodes[node].name));
  }
  return path;
}

EntryTypes::Found EntryTypes::of_start_value(Place subtree, std::string_view key) {
  std::optional<Found> all;
  const auto [begin, end] = nodes_.equal_range(subtree.byte);
  for (auto it = begin; it != end; ++it) {
    const Found here = of_name(path_of(it->second), key);
    all = all ? common(*all, here) : here;
  }
  return all.value_or(Found());
}

// SubTrees of one path have numbers: "grasp/", "grasp#2/".
EntryTypes::Found EntryTypes::of_name(const std::string& path, std::string_view key) {
  const auto [known, is_new] = by_name_.try_emplace(fmt::format("{}/{}", path, key));
  if (!is_new) return known->second;
  std::optional<Found> all;
  auto entry = names_.find(known->first);
  for (unsigned number = 2; entry != names_.end(); ++number) {
    const Found here = found(entries_[entry->second]);
    all = all ? common(*all, here) : here;
    entry = names_.find(fmt::format("{}#{}/{}", path, number, key));
  }
  return known->second = all.value_or(Found());
}

}  // namespace lockstep::host
