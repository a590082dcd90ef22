#include <algorithm>

#include "engine/bound_node.h"
#include "engine/groups.h"
#include "engine/nodes/decorator.h"
#include "engine/resources.h"

namespace lockstep::host {
namespace {

constexpr Parameter kUseResourcesParameters[] = {
    {.name = "pool",
     .type = ValueType::String,
     .doc = "The pool, a <resources> in root.",
     .required = true,
     .constant = true,
     .group = "resources"},
    {.name = "resources",
     .type = ValueType::String,
     .doc = "What the child needs to be ticked, all of it: left;gripper.",
     .required = true,
     .of_pool = true},
    {.name = "keep",
     .type = ValueType::Bool,
     .doc = "Once the child runs, it owns its resources until it completes or is halted; otherwise "
            "it may have to wait again in any tick.",
     .default_text = "false",
     .constant = true},
};
static_assert(kUseResourcesParameters[resources::kResources].of_pool);

std::optional<RuleBreak> rule_of_use_resources(const ParameterValues& given) {
  return resources::check_list(given, resources::kResources);
}

// A priority is at most this many increments for each member, so that the states of a run are
// finite. Nobody who is reached in every tick waits so long.
constexpr std::int64_t kMostWaits = 2;

void raise_priority(NodeContext& context, NodeIndex self, ResourceUse& use) {
  const NodeIndex pool = context.tree().membership(self).group;
  const std::int64_t increment = context.parameter(pool, resources::kIncrement).integer;
  const std::int64_t most = kMostWaits * context.node(pool).children * increment;
  use.priority = std::min(use.priority + increment, most);
}

// A member that is closed and reached has a SyncProgress inside that is held. That withholds the
// ticks itself, so that all around it goes on: its barrier, and a Timeout in between.
Status tick_child(NodeContext& context, NodeIndex self) {
  auto& use = context.state<ResourceUse>(self);
  if (use.grant == Grant::Denied) {
    raise_priority(context, self, use);
    if (context.hold_firmly(self + 1)) return Status::Running;
  }
  const bool has_run = context.status(self + 1) == Status::Running;
  const Status status = context.tick(self + 1);
  // A child that ran until now has used the resources in this tick.
  if (status == Status::Skipped && !has_run) resources::give_back(context, self);
  return status;
}

constexpr std::uint32_t kNever = 0xffffffff;

// Whether a script asks who owns a resource of the member's pool.
bool is_read(NodeContext& context, NodeIndex self) {
  const NodeIndex pool = context.tree().membership(self).group;
  return std::ranges::any_of(context.tree().readings, [pool](const BoundReading& it) {
    return it.what == Reading::What::Owner && it.node == pool;
  });
}

// The priority counts at any time, what it owns while its child keeps it or a script reads it.
void fold_use_resources(NodeContext& context, NodeIndex self) {
  auto& use = context.state<ResourceUse>(self);
  ResourceUse folded{};
  folded.priority = use.priority;
  if (resources::keeps(context, self)) folded.owned = use.owned;
  const bool runs = context.status(self) == Status::Running;
  if (runs && is_read(context, self) &&
      resources::owned_in_last_tick(context, use, ~ResourceSet{0})) {
    folded.owned = use.owned;
    folded.grant = Grant::Owned;  // and `asked` is the number that a fold gives the last tick
  } else {
    folded.asked = kNever;
  }
  use = folded;
}

Status tick_use_resources(NodeContext& context, NodeIndex self) {
  auto& use = context.state<ResourceUse>(self);
  context.groups().reach(context.tree().membership(self).group);
  // A child keeps its resources whatever the entry says meanwhile.
  if (!resources::keeps(context, self) && !reread(context, self)) return give_up(context, self);
  if (!resources::has_asked(context, use)) resources::ask(context, self);
  return tick_child(context, self);
}

}  // namespace

const NodeKind kUseResources{
    .type = {.id = "UseResources",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child in the ticks in which it owns all of its resources, which no "
                    "other member owns then; in the others the child is held, and this is Running.",
             .arity = {1, 1},
             .parameters = kUseResourcesParameters,
             .rule = rule_of_use_resources,
             .begins_child_once = true,
             .can_run = true},
    .tick = tick_use_resources,
    .progress = decorator::child_progress,
    .state_size = sizeof(ResourceUse),
    .fold = fold_use_resources,
    .chooses_to_read = true};

}  // namespace lockstep::host
