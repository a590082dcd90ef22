#include "engine/resources.h"

#include <algorithm>

#include "base/core/wording.h"

namespace lockstep::host::resources {
namespace {

// Whether the barriers and the outer pools of a member let ticks through.
bool is_open(NodeContext& context, NodeIndex gate) {
  const bool is_barrier = !is_pool(context.tree(), context.tree().membership(gate).group);
  if (is_barrier) return !is_held_at_barrier(context, gate);
  const auto& outer = context.state<ResourceUse>(gate);
  return has_asked(context, outer) && outer.grant == Grant::Owned;
}

void answer(NodeContext& context, const Member& member, ResourceSet wanted, Grant grant) {
  auto& use = context.state<ResourceUse>(member.node);
  use.asked = context.tick_number();
  use.grant = grant;
  use.owned = grant == Grant::Owned ? wanted : 0;
  use.limit = grant == Grant::Closed ? 0.0 : static_cast<double>(wanted);
  if (grant == Grant::Denied) use.limit = -use.limit;
  if (grant == Grant::Owned) use.priority = 0;
  context.state<ResourcePool>(member.group).owned |= use.owned;
}

}  // namespace

bool may_keep(const Tree& tree, NodeIndex member) {
  if (const BoundNode* bound = bound_of(tree, member)) {
    return tree.constants[tree.ports[bound->first_port + kKeep].constant] == Value(true);
  }
  return cell_of(tree, member, kKeep).boolean;
}

bool first_wins(const Tree& tree, NodeIndex pool) {
  return cell_of(tree, pool, kIncrement).integer == 0;
}

std::optional<RuleBreak> check_list(const ParameterValues& given, unsigned parameter) {
  const auto* list = std::get_if<std::string>(&given.values[parameter]);
  if (list == nullptr) return std::nullopt;
  const auto place = static_cast<int>(parameter);
  std::string_view rest = *list;
  std::string_view name = take_resource(rest);
  if (name.empty()) {
    return RuleBreak{place, "'resources' names nothing",
                     "write such as resources=\"left;gripper\""};
  }
  for (; !name.empty(); name = take_resource(rest)) {
    std::string_view behind = rest;
    for (auto it = take_resource(behind); !it.empty(); it = take_resource(behind)) {
      if (it != name) continue;
      return RuleBreak{place, "the resource '" + brief(name) + "' is named twice", ""};
    }
  }
  return std::nullopt;
}

void ask(NodeContext& context, NodeIndex node) {
  const Member& member = context.tree().membership(node);
  const auto wanted = static_cast<ResourceSet>(context.parameter(node, kResources).integer);
  const auto gates = context.tree().gates_of(member);
  if (!std::ranges::all_of(gates, [&](NodeIndex gate) { return is_open(context, gate); })) {
    return answer(context, member, wanted, Grant::Closed);
  }
  const ResourceSet owned = context.state<ResourcePool>(member.group).owned;
  answer(context, member, wanted, (owned & wanted) == 0 ? Grant::Owned : Grant::Denied);
}

bool keeps(NodeContext& context, NodeIndex node) {
  const bool may_keep = context.parameter(node, kKeep).boolean;
  return may_keep && context.status(node + 1) == Status::Running &&
         context.state<ResourceUse>(node).owned != 0;
}

void keep(NodeContext& context, NodeIndex node) {
  answer(context, context.tree().membership(node), context.state<ResourceUse>(node).owned,
         Grant::Owned);
}

void give_back(NodeContext& context, NodeIndex node) {
  auto& use = context.state<ResourceUse>(node);
  context.state<ResourcePool>(context.tree().membership(node).group).owned &= ~use.owned;
  use.owned = 0;
  use.limit = 0.0;
}

}  // namespace lockstep::host::resources
