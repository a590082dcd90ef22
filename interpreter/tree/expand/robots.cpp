#include "tree/expand/robots.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/core/resource_set.h"
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

// A parameter of a group; null: it is absent.
const Value* value_of(const CheckedTrees& trees, std::span<const Value> values,
                      const CheckedNode& group, std::string_view parameter) {
  const CheckedPort& port = trees.ports[group.first + place_of(*group.type, parameter)];
  return port.value == Port::kNone ? nullptr : &values[port.value];
}

// What a leaf needs to know of a team, and the member that this robot is.
struct OwnTeam {
  std::vector<std::string> members;
  std::string self;
  Value deadline;
};

// Nothing: reported, unless `report` is null.
std::optional<OwnTeam> own_team(const Definition& definition, const CheckedTrees& trees,
                                const CheckedNode& team, const Value* self, Place place,
                                const Reporter* report) {
  const Value* const members = value_of(trees, definition.values, team, "members");
  if (members == nullptr || self == nullptr) return std::nullopt;  // reported already
  if (trees.team_member == nullptr) {
    if (report != nullptr)
      report->at("unknown-node"_code, place, "this program knows no teams of robots");
    return std::nullopt;
  }
  OwnTeam own{std::get<std::vector<std::string>>(*members), std::get<std::string>(*self), 0.0};
  if (std::ranges::find(own.members, own.self) == own.members.end()) {
    const std::vector<std::string_view> known(own.members.begin(), own.members.end());
    if (report != nullptr) {
      report->at(
          "unknown-member"_code, place,
          fmt::format("'{}' is not a member of the team '{}'", brief(own.self), brief(team.name)),
          suggest(own.self, known, "members"));
    }
    return std::nullopt;
  }
  const Value* const deadline = value_of(trees, definition.values, team, "deadline");
  if (deadline != nullptr) own.deadline = *deadline;
  return own;
}

// A leaf behind the children of a node, whose ports are these.
void add_leaf(Definition& definition, const NodeType& type, std::uint32_t parent,
              std::string_view name, std::span<const Port> ports) {
  const auto number = static_cast<std::uint32_t>(definition.nodes.size());
  const auto first = static_cast<std::uint32_t>(definition.ports.size());
  definition.ports.insert(definition.ports.end(), ports.begin(), ports.end());
  definition.nodes.push_back({.type = &type,
                              .end = number + 1,
                              .parent = parent,
                              .children = 0,
                              .first = first,
                              .name = definition.texts.emplace_back(name),
                              .place = definition.nodes[parent].place});
  ++definition.nodes[parent].children;
}

Port constant_port(Definition& definition, Value value) {
  definition.values.push_back(std::move(value));
  return {.value = static_cast<std::uint32_t>(definition.values.size() - 1)};
}

}  // namespace

void add_robots(Definition& definition, const CheckedTrees& trees, const CheckedNode& team,
                std::uint32_t place, const Reporter& report) {
  const Value* const self = definition.constant(definition.nodes[place], "as");
  const auto own = own_team(definition, trees, team, self, definition.nodes[place].place, &report);
  if (!own) return;
  const std::string declaration = declaration_of(definition, definition.nodes[place], own->members);
  for (const std::string& name : own->members) {
    if (name == own->self) continue;
    std::vector<Port> ports;
    for (Value value : {Value(std::string(team.name)), Value(own->self), own->deadline, Value(name),
                        Value(declaration)}) {
      ports.push_back(constant_port(definition, std::move(value)));
    }
    add_leaf(definition, *trees.team_member, place, name, ports);
  }
}

std::string_view team_of(const CheckedTrees& trees, std::span<const Value> values,
                         const CheckedNode& pool) {
  const Value* const name = value_of(trees, values, pool, "team");
  return name == nullptr ? std::string_view() : std::get<std::string>(*name);
}

void add_asker(Definition& definition, const CheckedTrees& trees, const CheckedNode& pool,
               const CheckedNode& team, std::uint32_t place, std::uint32_t number,
               const Reporter& report) {
  const Value* const self = value_of(trees, definition.values, pool, "as");
  const auto own =
      own_team(definition, trees, team, self, pool.place, number == 0 ? &report : nullptr);
  const Value* const declared = value_of(trees, definition.values, pool, "resources");
  if (!own || declared == nullptr) return;
  const Value names = *declared;  // values move when some are added
  const DefinitionNode node = definition.nodes[place];
  const auto refuse = [&](std::string_view message, std::string_view hint) {
    report.at("bad-attributes"_code, node.place, std::string(message), std::string(hint));
  };
  if (number >= kMostAsked) {
    return refuse(fmt::format("more than {} nodes use the pool '{}', which robots share",
                              kMostAsked, brief(pool.name)),
                  "use it once around what they do");
  }
  const Value* const on_change = definition.constant(node, "on_change");
  if (on_change != nullptr && *on_change != Value("keep")) {
    return refuse("robots share this pool, so its resources are kept until the child ends",
                  "leave out 'on_change'");
  }
  ResourceNames list(definition.resources_of(node));
  while (!list.next().empty()) {
  }
  if (list.choices() != 0) {
    return refuse("robots share this pool, so any(…) of its resources cannot be chosen",
                  "name the resources that the child needs");
  }
  // Its own ports, since others of the type may share them.
  const auto count = node.type->parameters.size();
  const auto first = static_cast<std::uint32_t>(definition.ports.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Port port = definition.ports[node.first + i];
    definition.ports.push_back(port);
  }
  const std::size_t keep = place_of(*node.type, "keep");
  const Port kept = constant_port(definition, true);
  definition.ports[first + keep] = kept;
  definition.nodes[place].first = first;

  const Port wanted = definition.ports[first + place_of(*node.type, "resources")];
  std::vector<Port> ports;
  for (Value value : {Value(std::string(team.name)), Value(own->self), own->deadline,
                      Value(own->members), names, Value(std::int64_t{number})}) {
    ports.push_back(constant_port(definition, std::move(value)));
  }
  ports.push_back(wanted);
  add_leaf(definition, *trees.team_resources, place, pool.name, ports);
}

}  // namespace lockstep::host
