#include "engine/node_scripts.h"
#include "engine/nodes/kinds.h"
#include "engine/nodes/timed.h"

namespace lockstep::host {
namespace {

constexpr unsigned kWaitsFor = 1;

constexpr Parameter kWaitUntilParameters[] = {
    timed::kLongestWait,
    {.name = "code",
     .type = ValueType::String,
     .doc = "The condition that it waits for, such as progress(base) >= 0.5.",
     .required = true,
     .is_script = true},
};

Status tick_wait_until(NodeContext& context, NodeIndex self) {
  timed::count(context, self);
  const auto holds = context.scripts().holds(self, kWaitsFor);
  if (!holds) return Status::Failure;
  if (*holds) return Status::Success;
  return timed::has_waited(context, self) ? Status::Failure : Status::Running;
}

}  // namespace

const NodeKind kWaitUntil{.type = {.id = "WaitUntil",
                                   .category = NodeCategory::Action,
                                   .doc = "Running until its script is true, then Success; Failure "
                                          "when the time is over.",
                                   .arity = {0, 0},
                                   .parameters = kWaitUntilParameters,
                                   .can_run = true},
                          .tick = tick_wait_until,
                          .progress = [](NodeContext&, NodeIndex) { return 0.0; },
                          .state_size = sizeof(timed::State),
                          .pause = timed::pause,
                          .fold = timed::fold,
                          .reads_own_hold = true,
                          .if_moved = IfMoved::Same};

}  // namespace lockstep::host
