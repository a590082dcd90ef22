// A pool of resources, beside the trees. Before the root is ticked it decides which of its members
// own their resources in this tick.
#include "engine/resources.h"
#include "engine/nodes/fold.h"

#include <algorithm>
#include <ranges>

#include "engine/nodes/kinds.h"

namespace lockstep::host {
namespace {

constexpr Parameter kResourcesParameters[] = {
    {.name = "increment",
     .type = ValueType::Int,
     .doc = "What the priority of a member grows by in a tick in which it waits; 0: the first in "
            "the tree always wins, and the others may wait indefinitely.",
     .default_text = "1",
     .range = {.min = 0, .max = 1000000},
     .constant = true},
    {.name = "resources",
     .type = ValueType::String,
     .doc = "All names in the pool: left;right. When absent, those that its members name in the "
            "tree.",
     .constant = true},
    {.name = "team",
     .type = ValueType::String,
     .doc = "The pool is shared with the other robots of this team, a <team> in root.",
     .constant = true,
     .group = "team"},
    {.name = "as",
     .type = ValueType::String,
     .doc = "With `team`: the member that this robot is.",
     .constant = true},
};
static_assert(kResourcesParameters[resources::kTeam].name == "team" &&
              kResourcesParameters[resources::kAs].name == "as");

std::optional<RuleBreak> rule_of_team_pool(const ParameterValues& given) {
  const bool is_of_team = given.is_given(resources::kTeam);
  if (is_of_team && !given.is_given(resources::kAs)) {
    return RuleBreak{resources::kTeam, "a pool of a team needs the name of this robot",
                     "add such as as=\"${me}\""};
  }
  if (!is_of_team && given.is_given(resources::kAs))
    return RuleBreak{resources::kAs, "'as' is for a pool of a team", "add team=\"…\""};
  constexpr int kNames = 1;
  if (is_of_team && !given.is_given(kNames)) {
    return RuleBreak{resources::kTeam, "a pool of a team names all of its resources",
                     "add such as resources=\"north;south\""};
  }
  return std::nullopt;
}

std::optional<RuleBreak> rule_of_resources(const ParameterValues& given) {
  constexpr unsigned kNames = 1;
  if (auto broken = rule_of_team_pool(given)) return broken;
  return resources::check_list(given, kNames, false);
}

// Lets those keep their resources that may. Of all others that ask, their numbers.
std::span<std::uint32_t> who_asks(NodeContext& context, NodeIndex self,
                                  std::span<const Member> members) {
  const auto numbers = context.child_states<std::uint32_t>(self);
  std::size_t count = 0;
  for (const Member& member : members) {
    const bool runs = context.status(member.node) == Status::Running;
    if (runs) resources::forget_unasked(context, member.node);
    context.state<ResourceUse>(member.node).limit = 0;
    if (!runs) continue;
    const bool asks =
        resources::kept_set(context, member.node) == 0 || !resources::keep(context, member.node);
    if (asks && !is_held_by_parallel(context, member.node) &&  // else a tick that reaches it asks
        context.parameters().read(member.node).empty()) {
      numbers[count++] = member.number;
    }
  }
  return numbers.first(count);
}

// Those around it come first, however urgent they are: it owns nothing without them.
void ask_in_turn(NodeContext& context, const Member& member,
                 std::span<const std::uint32_t> asking) {
  const Tree& tree = context.tree();
  const auto has_asked = [&](NodeIndex node) {
    return resources::has_asked(context, context.state<ResourceUse>(node));
  };
  for (const NodeIndex gate : tree.gates_of(member) | std::views::reverse) {
    const Member& outer = tree.membership(gate);
    const bool asks = outer.group == member.group && !has_asked(gate) &&
                      std::ranges::find(asking, outer.number) != asking.end();
    if (asks) resources::ask(context, gate);
  }
  if (!has_asked(member.node)) resources::ask(context, member.node);
}

Status tick_resources(NodeContext& context, NodeIndex self) {
  context.state<ResourcePool>(self).owned = 0;
  const auto members = context.tree().members_of(self);
  const auto asking = who_asks(context, self, members);
  const auto priority = [&](std::uint32_t number) {
    return context.state<ResourceUse>(members[number].node).priority;
  };
  std::ranges::sort(asking, [&](std::uint32_t one, std::uint32_t other) {
    if (priority(one) != priority(other)) return priority(one) > priority(other);
    return one < other;
  });
  for (const std::uint32_t number : asking) ask_in_turn(context, members[number], asking);
  return Status::Running;
}

}  // namespace

const NodeKind kResources{
    .type = {.id = "resources",
             .category = NodeCategory::Group,
             .doc = "A pool of things that only one node can use at a time: arms, a gripper, the "
                    "space in a door. UseResources takes them.",
             .arity = {0, 0},
             .parameters = kResourcesParameters,
             .rule = rule_of_resources,
             .synchronization = Synchronization::Resources},
    .tick = tick_resources,
    .progress = [](NodeContext&, NodeIndex) { return 0.0; },
    .state_size = sizeof(ResourcePool),
    .state_per_child = sizeof(std::uint32_t),
    .fold = fold::dead,
    .reads_hold_of_members = true};

}  // namespace lockstep::host
