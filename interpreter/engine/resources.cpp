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

bool is_inside(const Tree& tree, NodeIndex inner, NodeIndex outer) {
  return outer < inner && inner < tree.nodes[outer].end;
}

// Whether a Sequence has ticked the one before it comes to the other.
bool is_before(const Tree& tree, NodeIndex one, NodeIndex other) {
  if (one >= other) return false;
  NodeIndex ancestor = tree.labels[other].parent;
  while (!is_inside(tree, one, ancestor)) ancestor = tree.labels[ancestor].parent;
  return tree.labels[ancestor].type->goes_on_after == Status::Success;
}

// What other members own in this tick.
struct Owned {
  ResourceSet by_others = 0;
  ResourceSet before = 0;   // by those that a member takes over from
  ResourceSet related = 0;  // by those around it and inside of it: no obstacle
};

Owned owned_by_others(NodeContext& context, NodeIndex node, bool takes_over) {
  const Tree& tree = context.tree();
  const NodeIndex pool = tree.membership(node).group;
  Owned owned;
  if (!tree.group(pool).has_relatives) {
    owned.by_others = context.state<ResourcePool>(pool).owned & ~kept_set(context, node);
    return owned;
  }
  for (const Member& it : tree.members_of(pool)) {
    const NodeIndex other = it.node;
    const ResourceSet set = owned_set(context.state<ResourceUse>(other).limit);
    if (set == 0 || other == node) continue;
    if (is_inside(tree, other, node) || is_inside(tree, node, other)) {
      owned.related |= set;
    } else if (takes_over && context.status(other) != Status::Running &&
               is_before(tree, other, node)) {
      owned.before |= set;
    } else {
      owned.by_others |= set;
    }
  }
  return owned;
}

// Its child runs, or its team is asked.
bool is_under_way(NodeContext& context, NodeIndex node) {
  if (context.status(node + 1) == Status::Running) return true;
  const auto asker = asker_of(context.tree(), node);
  return asker && context.status(node) == Status::Running && context.status(*asker) != Status::Idle;
}

// It owns these in this tick, and what it keeps.
void own(NodeContext& context, const Member& member, ResourceSet granted, ResourceSet kept) {
  auto& use = context.state<ResourceUse>(member.node);
  use.asked = context.tick_number();
  use.grant = Grant::Owned;
  use.granted = granted;
  use.limit = static_cast<double>(granted | kept);
  use.priority = 0;
  context.state<ResourcePool>(member.group).owned |= granted | kept;
}

// It owns what it keeps.
void refuse(NodeContext& context, const Member& member, Grant why, ResourceSet wanted,
            ResourceSet kept) {
  auto& use = context.state<ResourceUse>(member.node);
  use.asked = context.tick_number();
  use.grant = why;
  use.limit = why == Grant::Closed ? static_cast<double>(kept) : limit_of_waiting(wanted, kept);
}

// What it gets if `taken` are owned by others: of a choice what it had before, or else the first
// that is free. It waits for all that it names.
ResourceSet choose(std::span<const double> request, ResourceSet taken, ResourceSet had) {
  const auto all = static_cast<ResourceSet>(request.front());
  const auto choices = request.subspan(1);
  const auto is_free = [&](double set) { return (static_cast<ResourceSet>(set) & taken) == 0; };
  for (const double set : choices) {
    if ((static_cast<ResourceSet>(set) & had) != 0 && is_free(set))
      return all | static_cast<ResourceSet>(set);
  }
  const auto first = std::ranges::find_if(choices, is_free);
  return first != choices.end() ? all | static_cast<ResourceSet>(*first) : all_resources(request);
}

}  // namespace

OnChange on_change(const Tree& tree, NodeIndex member) {
  const auto said = static_cast<OnChange>(cell_of(tree, member, kOnChange).integer);
  const bool keeps = said == OnChange::Release && cell_of(tree, member, kKeep).boolean;
  return keeps ? OnChange::Keep : said;
}

bool first_wins(const Tree& tree, NodeIndex pool) {
  return cell_of(tree, pool, kIncrement).integer == 0;
}

std::optional<RuleBreak> check_list(const ParameterValues& given, unsigned parameter,
                                    bool may_choose) {
  const auto* list = std::get_if<std::string>(&given.values[parameter]);
  if (list == nullptr) return std::nullopt;
  const auto place = static_cast<int>(parameter);
  ResourceNames names(*list);
  std::string_view name = names.next();
  if (name.empty()) {
    return RuleBreak{place, "'resources' names nothing",
                     "write such as resources=\"left;gripper\""};
  }
  for (; !name.empty(); name = names.next()) {
    ResourceNames behind = names;
    for (auto it = behind.next(); !it.empty(); it = behind.next()) {
      if (it != name) continue;
      return RuleBreak{place, "the resource '" + brief(name) + "' is named twice", ""};
    }
  }
  if (names.choices() > 0 && !may_choose) {
    return RuleBreak{place, "a pool has all of its resources, not any(…) of them",
                     "name them: resources=\"left;right\""};
  }
  if (names.choices() > 1) {
    return RuleBreak{place, "'resources' has any(…) twice", "one is allowed: any(left; right)"};
  }
  if (names.is_open()) return RuleBreak{place, "'any(' has no ')'", "write any(left; right)"};
  return std::nullopt;
}

void ask(NodeContext& context, NodeIndex node) {
  const Member& member = context.tree().membership(node);
  auto& use = context.state<ResourceUse>(node);
  const auto request = context.parameters().numbers(node, kResources);
  const OnChange what = on_change(context.tree(), node);
  const bool begins = context.first_tick(node);
  if (begins || !is_under_way(context, node)) use.owned = 0;
  if (begins || keeps(context, node)) use.handed = 0;
  const bool is_small = context.tree().group(member.group).resources.size() <= kMaxExchanged;
  const bool takes_over = begins && what != OnChange::Release && is_small;
  const Owned owned = owned_by_others(context, node, takes_over);
  if (begins) {
    const ResourceSet needed = what == OnChange::Keep ? all_resources(request) : owned.before;
    use.handed = owned.before & needed & ~owned.by_others;
  }
  const ResourceSet kept = kept_set(context, node);
  const auto gates = context.tree().gates_of(member);
  if (!std::ranges::all_of(gates, [&](NodeIndex gate) { return is_open(context, gate); })) {
    return refuse(context, member, Grant::Closed, 0, kept);
  }
  const ResourceSet wanted = choose(request, owned.by_others, use.owned | use.handed);
  if ((owned.by_others & wanted) != 0)
    return refuse(context, member, Grant::Denied, wanted & ~(owned.related & ~owned.by_others),
                  kept);
  if (!keeps(context, node)) use.owned = wanted;
  own(context, member, wanted, kept);
}

std::optional<NodeIndex> asker_of(const Tree& tree, NodeIndex node) {
  const NodeIndex asker = tree.nodes[node + 1].end;
  return asker == tree.nodes[node].end ? std::nullopt : std::optional(asker);
}

bool keeps(NodeContext& context, NodeIndex node) {
  return on_change(context.tree(), node) != OnChange::Release && is_under_way(context, node) &&
         context.state<ResourceUse>(node).owned != 0;
}

ResourceSet kept_set(NodeContext& context, NodeIndex node) {
  const auto& use = context.state<ResourceUse>(node);
  return keeps(context, node) ? use.owned : use.handed;
}

bool keep(NodeContext& context, NodeIndex node) {
  const Member& member = context.tree().membership(node);
  auto& use = context.state<ResourceUse>(node);
  bool asks = !keeps(context, node);
  if (!asks && on_change(context.tree(), node) == OnChange::Exchange) {
    const bool is_readable = context.parameters().read(node).empty();
    const auto request = context.parameters().numbers(node, kResources);
    asks = !is_readable || choose(request, 0, use.owned) != use.owned;
  }
  if (!asks) {
    own(context, member, use.owned, 0);
    return true;
  }
  const ResourceSet kept = kept_set(context, node);
  use.limit = static_cast<double>(kept);
  context.state<ResourcePool>(member.group).owned |= kept;
  return false;
}

void forget_unasked(NodeContext& context, NodeIndex node) {
  auto& use = context.state<ResourceUse>(node);
  const auto asker = asker_of(context.tree(), node);
  const bool waits_for_team = asker && context.status(*asker) != Status::Success;
  if (waits_for_team && owns(use.limit)) use.owned = 0;
}

void give_back(NodeContext& context, NodeIndex node) {
  auto& use = context.state<ResourceUse>(node);
  context.state<ResourcePool>(context.tree().membership(node).group).owned &= ~use.owned;
  use.owned = use.handed = 0;
  use.limit = 0.0;
}

}  // namespace lockstep::host::resources
