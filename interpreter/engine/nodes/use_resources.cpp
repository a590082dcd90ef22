#include <algorithm>

#include "base/blackboard/entry.h"
#include "engine/bound_node.h"
#include "engine/groups.h"
#include "engine/node_ports.h"
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
     .doc = "What the child needs to be ticked, all of it: left;gripper. One of several: "
            "dock; any(crane_1; crane_2).",
     .required = true,
     .of_pool = true},
    {.name = "keep",
     .type = ValueType::Bool,
     .doc = "Once the child runs, it owns its resources until it completes or is halted; otherwise "
            "it may have to wait again in any tick.",
     .default_text = "false",
     .constant = true},
    {.name = "on_change",
     .type = ValueType::String,
     .doc =
         "While the child runs and the entry changes: release (it requests in each tick what the "
         "entry names), keep (as keep=\"true\"), or exchange (it keeps what it has, and is held, "
         "until it gets what the entry names).",
     .choices = resources::kOnChangeChoices,
     .constant = true},
    {.name = "granted",
     .type = ValueType::String,
     .doc = "The resources that the child owns, such as crane_2. It is written before the child is "
            "ticked.",
     .direction = Direction::Output},
};
static_assert(kUseResourcesParameters[resources::kResources].of_pool &&
              kUseResourcesParameters[resources::kGranted].direction == Direction::Output);

std::optional<RuleBreak> rule_of_use_resources(const ParameterValues& given) {
  if (auto broken = resources::check_list(given, resources::kResources, true)) return broken;
  const bool keeps = given.values[resources::kKeep] == Value(true);
  if (!keeps || given.values[resources::kOnChange] != Value("release")) return std::nullopt;
  return RuleBreak{static_cast<int>(resources::kOnChange),
                   "keep=\"true\" and on_change=\"release\" contradict each other",
                   "leave out one of them, or write on_change=\"exchange\""};
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

// Writes what it owns, if the entry does not say so.
void tell_granted(NodeContext& context, NodeIndex self) {
  Entry* const entry = context.ports().entry_of_bound(self, resources::kGranted);
  if (entry == nullptr) return;
  const ResourceSet owned = context.state<ResourceUse>(self).owned;
  const auto& names = context.tree().group(context.tree().membership(self).group).resources;
  const auto* text = std::get_if<std::string>(&entry->value());
  if (text == nullptr) {
    write_entry(*entry, ValueType::String, nullptr, to_text(owned, names));
  } else if (!is_text_of(*text, owned, names)) {
    to_text(owned, names, std::get<std::string>(entry->to_write()));
  }
}

// Where robots share the pool, their team grants what this tree does. It does so once for an
// activation, and what asks it is done then.
bool is_granted_by_team(NodeContext& context, NodeIndex self) {
  const auto asker = resources::asker_of(context.tree(), self);
  if (!asker || context.status(*asker) == Status::Success) return true;
  if (context.tick(*asker) == Status::Success) return true;
  auto& use = context.state<ResourceUse>(self);
  use.limit = limit_of_waiting(use.granted, 0);
  return false;
}

// A member that is closed and reached has a SyncProgress inside that is held. That withholds the
// ticks itself, so that all around it goes on: its barrier, and a Timeout in between.
Status tick_child(NodeContext& context, NodeIndex self) {
  auto& use = context.state<ResourceUse>(self);
  if (use.grant == Grant::Denied) {
    raise_priority(context, self, use);
    if (context.hold_firmly(self + 1)) return Status::Running;
  }
  if (use.grant == Grant::Owned) {
    use.owned = use.granted;
    if (!is_granted_by_team(context, self)) {
      context.hold_firmly(self + 1);
      return Status::Running;
    }
    if (!context.parameters().are_constant(self)) tell_granted(context, self);
  }
  const bool has_run = context.status(self + 1) == Status::Running;
  const Status status = context.tick(self + 1);
  // A child that ran until now has used the resources in this tick.
  if (status == Status::Skipped && !has_run) resources::give_back(context, self);
  return status;
}

// Whether a script asks who owns a resource of the member's pool.
bool is_read(NodeContext& context, NodeIndex self) {
  const NodeIndex pool = context.tree().membership(self).group;
  return std::ranges::any_of(context.tree().readings, [pool](const BoundReading& it) {
    return it.what == Reading::What::Owner && it.node == pool;
  });
}

// The priority counts at any time. While its child runs, so does what it owns, if it keeps that, or
// chooses it again; and what it owned in the last tick, if a script reads that.
void fold_use_resources(NodeContext& context, NodeIndex self) {
  resources::forget_unasked(context, self);
  auto& use = context.state<ResourceUse>(self);
  ResourceUse folded{};
  folded.priority = use.priority;
  const bool may_choose = !context.parameters().are_constant(self) ||
                          context.parameters().numbers(self, resources::kResources).size() > 1;
  const bool runs = context.status(self + 1) == Status::Running;
  if (resources::keeps(context, self) || (may_choose && runs)) folded.owned = use.owned;
  const bool waits = context.status(self) == Status::Running;
  if (waits && !resources::keeps(context, self)) folded.handed = use.handed;
  if (context.status(self) == Status::Running && is_read(context, self)) {
    folded.limit = static_cast<double>(owned_set(use.limit));
  }
  use = folded;
}

Status tick_use_resources(NodeContext& context, NodeIndex self) {
  auto& use = context.state<ResourceUse>(self);
  context.groups().reach(context.tree().membership(self).group);
  // What is kept does not depend on what the entry says meanwhile.
  const bool reads = resources::on_change(context.tree(), self) != resources::OnChange::Keep ||
                     !resources::keeps(context, self);
  if (reads && !reread(context, self)) return give_up(context, self);
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
