#include "leaves/plugin/contract/descriptor_leaf.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/node_kind.h"
#include "leaves/plugin/contract/descriptor_behavior.h"
#include "leaves/plugin/contract/descriptor_port.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kLeafSizeIn10 =
    offsetof(lockstep_leaf_type, get_extension) + sizeof(lockstep_leaf_type::get_extension);

// Tags of the tree language that are no node kinds.
constexpr std::string_view kReservedTags[] = {"root",    "BehaviorTree", "SubTree", "include",
                                              "plugin",  "arg",          "Action",  "Condition",
                                              "Control", "Decorator"};

// An ID that only one of the languages has is free in the others: 'Wait', 'Sleep'.
bool is_taken(std::string_view id) {
  const auto has = [id](const LanguageRules* rules) {
    return std::ranges::any_of(rules->kinds,
                               [id](const NodeKind* kind) { return kind->type.id == id; });
  };
  return std::ranges::find(kReservedTags, id) != std::end(kReservedTags) ||
         std::ranges::all_of(languages(), has);
}

std::optional<Problem> check_id(const char* id) {
  if (id == nullptr) return Problem{"has no id", "set lockstep_leaf_type::id"};
  if (!is_attribute_name(id)) {
    return Problem{fmt::format("has the id '{}'", id),
                   "an id is a letter, then letters, digits, '_' and '-'"};
  }
  if (is_taken(id)) {
    return Problem{fmt::format("has the id '{}', which is a tag of the tree language", id),
                   "give the leaf another id"};
  }
  return std::nullopt;
}

std::optional<Problem> check_leaf(const lockstep_leaf_type& leaf) {
  if (auto refusal = check_id(leaf.id)) return refusal;
  if (leaf.kind < LOCKSTEP_ACTION || leaf.kind > LOCKSTEP_DECORATOR) {
    return Problem{fmt::format("('{}') has kind {}", leaf.id, leaf.kind),
                   "use LOCKSTEP_ACTION, LOCKSTEP_CONDITION, LOCKSTEP_CONTROL or "
                   "LOCKSTEP_DECORATOR, 1 to 4"};
  }
  if (leaf.max_children != 0 && leaf.max_children < leaf.min_children) {
    return Problem{fmt::format("('{}') has at least {} and at most {} children", leaf.id,
                               leaf.min_children, leaf.max_children),
                   "set lockstep_leaf_type::max_children to 0 for any number"};
  }
  const char* missing = leaf.create == nullptr    ? "create"
                        : leaf.destroy == nullptr ? "destroy"
                        : leaf.tick == nullptr    ? "tick"
                                                  : nullptr;
  if (missing != nullptr) {
    return Problem{fmt::format("('{}') has no {} function", leaf.id, missing),
                   "create, destroy and tick must not be NULL"};
  }
  if (leaf.port_count > kMaxDescriptorCount) {
    return Problem{fmt::format("('{}') claims to have {} ports, expected at most {}", leaf.id,
                               leaf.port_count, kMaxDescriptorCount),
                   "check lockstep_leaf_type::port_count"};
  }
  if (leaf.port_count != 0 && leaf.ports == nullptr) {
    return Problem{fmt::format("('{}') has {} ports but no list of them", leaf.id, leaf.port_count),
                   "set lockstep_leaf_type::ports"};
  }
  if ((leaf.save == nullptr) != (leaf.restore == nullptr)) {
    return Problem{
        fmt::format("('{}') has {} without {}", leaf.id, leaf.save != nullptr ? "save" : "restore",
                    leaf.save != nullptr ? "restore" : "save"),
        "a leaf type has both or none"};
  }
  if ((leaf.more_ports == nullptr) != (leaf.describe == nullptr)) {
    return Problem{fmt::format("('{}') has {} without {}", leaf.id,
                               leaf.describe != nullptr ? "describe" : "more_ports",
                               leaf.describe != nullptr ? "more_ports" : "describe"),
                   "a leaf type has both or none"};
  }
  return std::nullopt;
}

std::optional<Problem> read_ports(const lockstep_leaf_type& leaf, std::string_view plugin,
                                  Descriptors::Leaf& into) {
  std::vector<Parameter>& ports = into.parameters;
  ports.reserve(leaf.port_count);
  for (std::uint32_t index = 0; index < leaf.port_count; ++index) {
    Parameter port{};
    if (auto refusal =
            read_port(leaf.ports[index], plugin, ports, into.choices.emplace_back(), port)) {
      return Problem{fmt::format("('{}'): port {} {}", leaf.id, index, refusal->message),
                     std::move(refusal->hint)};
    }
    ports.push_back(port);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Problem> read_leaf(const lockstep_leaf_type* from, std::string_view plugin,
                                 Descriptors::Leaf& leaf) {
  if (from == nullptr) return Problem{"is NULL", "list leaf_type_count leaf types"};
  if (from->struct_size < kLeafSizeIn10) {
    return Problem{
        fmt::format("has struct_size {}, expected at least {}", from->struct_size, kLeafSizeIn10),
        "set it to sizeof(lockstep_leaf_type)"};
  }
  leaf.type = covered_copy(from, from->struct_size);
  if (auto refusal = check_leaf(leaf.type)) return refusal;
  if (auto refusal = read_ports(leaf.type, plugin, leaf)) return refusal;
  return check_behavior(leaf.type, leaf.parameters);
}

}  // namespace lockstep::host
