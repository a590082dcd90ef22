#include <algorithm>

#include "engine/nodes/kinds.h"
#include "engine/nodes/timed.h"

namespace lockstep::host {
namespace {

constexpr Parameter kWaitParameters[] = {
    timed::seconds("How long to wait; the time during which it is held does not count."),
};

Nanoseconds duration(const NodeContext& context, NodeIndex self) {
  return from_seconds(context.parameter(self, timed::kSeconds).number);
}

Status tick_wait(NodeContext& context, NodeIndex self) {
  timed::count(context, self);
  return timed::is_over(context, self) ? Status::Success : Status::Running;
}

double progress_of_wait(NodeContext& context, NodeIndex self) {
  return std::min(1.0,
                  to_seconds(timed::counted(context, self)) / to_seconds(duration(context, self)));
}

}  // namespace

const NodeKind kWait{.type = {.id = "Wait",
                              .category = NodeCategory::Action,
                              .doc = "Running for a time, then Success.",
                              .arity = {0, 0},
                              .parameters = kWaitParameters,
                              .can_run = true},
                     .tick = tick_wait,
                     .progress = progress_of_wait,
                     .state_size = sizeof(timed::State),
                     .pause = timed::pause,
                     .fold = timed::fold,
                     .reads_own_hold = true,
                     .if_moved = IfMoved::Same};

}  // namespace lockstep::host
