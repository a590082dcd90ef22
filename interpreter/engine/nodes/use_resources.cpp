#include "engine/nodes/decorator.h"
#include "engine/resources.h"

namespace lockstep {
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

std::int64_t increment(const Ticker& ticker, NodeIndex self) {
  return ticker.parameter(ticker.membership(self).group, resources::kIncrement).integer;
}

Status tick_child(Ticker& ticker, NodeIndex self) {
  auto& use = ticker.state<ResourceUse>(self);
  if (use.grant == Grant::Owned) {
    const Status status = ticker.tick(self + 1);
    if (status == Status::Skipped) resources::give_back(ticker, self);
    return status;
  }
  if (use.grant == Grant::Denied) use.priority += increment(ticker, self);
  if (ticker.activity(self + 1) == Activity::Running) ticker.pause(self + 1);
  return Status::Running;
}

Status tick_use_resources(Ticker& ticker, NodeIndex self) {
  auto& use = ticker.state<ResourceUse>(self);
  ticker.reach(ticker.membership(self).group);
  if (!resources::has_asked(ticker, use)) resources::ask(ticker, self);
  return tick_child(ticker, self);
}

}  // namespace

const NodeKind kUseResources{
    .type = {.id = "UseResources",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child in the ticks in which it owns all of its resources, which "
                    "nobody else owns then; in the others the child is held, and this is Running.",
             .arity = {1, 1},
             .parameters = kUseResourcesParameters,
             .rule = rule_of_use_resources,
             .can_run = true},
    .tick = tick_use_resources,
    .progress = decorator::child_progress,
    .state_size = sizeof(ResourceUse)};

}  // namespace lockstep
