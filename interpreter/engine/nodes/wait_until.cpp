#include "engine/node_scripts.h"
#include "engine/nodes/kinds.h"
#include "engine/nodes/timed.h"

namespace lockstep::host {
namespace {

constexpr unsigned kWaitsFor = 1;

// The time comes first, as in all kinds that count it.
constexpr Parameter kWaitUntilParameters[] = {
    {.name = "timeout",
     .type = ValueType::Double,
     .doc =
         "How long to wait at most, without the time during which it is held; without limit when "
         "absent.",
     .unit = "s",
     .range = {.min = 0, .max = 1e9, .min_excluded = true}},
    {.name = "code",
     .type = ValueType::String,
     .doc = "The condition that it waits for, such as progress(base) >= 0.5.",
     .required = true,
     .is_script = true},
};

constexpr double kNoTimeout = 0;  // the cell of an absent number

Status tick_wait_until(NodeContext& context, NodeIndex self) {
  timed::count(context, self);
  const auto holds = context.scripts().holds(self, kWaitsFor);
  if (!holds) return Status::Failure;
  if (*holds) return Status::Success;
  const bool has_limit = context.parameter(self, timed::kSeconds).number != kNoTimeout;
  return has_limit && timed::is_over(context, self) ? Status::Failure : Status::Running;
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
