#include "tree/expand/robots.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/core/suggest.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

std::size_t place_of(const NodeType& type, std::string_view parameter) {
  const auto it = std::ranges::find(type.parameters, parameter, &Parameter::name);
  return static_cast<std::size_t>(it - type.parameters.begin());
}

// Two trees of a team must agree in this: how far members wait for each other, and who they are.
std::string declaration_of(const Definition& definition, const DefinitionNode& node,
                           std::vector<std::string> members) {
  std::ranges::sort(members);
  std::string text = to_text(Value(std::move(members)));
  const NodeType& type = *node.type;
  for (std::size_t i = 0; i < type.parameters.size(); ++i) {
    const std::string_view name = type.parameters[i].name;
    if (name == "team" || name == "as" || name == "give_up") continue;
    const Value* const value = definition.constant(node, i);
    if (value != nullptr) text += fmt::format(" {}={}", name, to_text(*value));
  }
  return text;
}

}  // namespace

void add_robots(Definition& definition, const CheckedTrees& trees, const CheckedNode& team,
                std::uint32_t place, const Reporter& report) {
  const auto value_of = [&](std::string_view parameter) -> const Value* {
    const CheckedPort& port = trees.ports[team.first + place_of(*team.type, parameter)];
    return port.value == Port::kNone ? nullptr : &definition.values[port.value];
  };
  const Value* const members = value_of("members");
  const Value* const self = definition.constant(definition.nodes[place], "as");
  if (members == nullptr || self == nullptr) return;  // reported already
  if (trees.team_member == nullptr) {
    report.at("unknown-node"_code, definition.nodes[place].place,
              "this program knows no teams of robots");
    return;
  }
  const auto names = std::get<std::vector<std::string>>(*members);
  const auto own = std::get<std::string>(*self);
  if (std::ranges::find(names, own) == names.end()) {
    const std::vector<std::string_view> known(names.begin(), names.end());
    report.at("unknown-member"_code, definition.nodes[place].place,
              fmt::format("'{}' is not a member of the team '{}'", brief(own), brief(team.name)),
              suggest(own, known, "members"));
    return;
  }
  const Value* const given = value_of("deadline");
  const Value deadline = given != nullptr ? *given : Value(0.0);
  const std::string declaration = declaration_of(definition, definition.nodes[place], names);
  for (const std::string& name : names) {
    if (name == own) continue;
    const auto number = static_cast<std::uint32_t>(definition.nodes.size());
    const auto first = static_cast<std::uint32_t>(definition.ports.size());
    const Value values[] = {Value(std::string(team.name)), Value(own), Value(name),
                            Value(declaration), deadline};
    for (const Value& value : values) {
      definition.ports.push_back({.value = static_cast<std::uint32_t>(definition.values.size())});
      definition.values.push_back(value);
    }
    definition.nodes.push_back({.type = trees.team_member,
                                .end = number + 1,
                                .parent = place,
                                .children = 0,
                                .first = first,
                                .name = definition.texts.emplace_back(name),
                                .place = definition.nodes[place].place});
    ++definition.nodes[place].children;
  }
}

}  // namespace lockstep::host
