#include "base/core/time_progress.h"
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

template <bool kObeys>
Status tick_wait(NodeContext& context, NodeIndex self) {
  timed::count<kObeys>(context, self);
  return timed::is_over(context, self) ? Status::Success : Status::Running;
}

template <bool kObeys>
double progress_of_wait(NodeContext& context, NodeIndex self) {
  return progress_of_time(timed::counted<kObeys>(context, self), duration(context, self),
                          context.deadlines());
}

extern const NodeKind kObeyingWait;

}  // namespace

const NodeKind kWait{.type = {.id = "Wait",
                              .category = NodeCategory::Action,
                              .doc = "Running for a time, then Success.",
                              .arity = {0, 0},
                              .parameters = kWaitParameters,
                              .can_run = true,
                              .can_be_slowed = true},
                     .tick = tick_wait<false>,
                     .progress = progress_of_wait<false>,
                     .state_size = sizeof(timed::State),
                     .pause = timed::pause,
                     .fold = timed::fold,
                     .obeying = &kObeyingWait,
                     .reads_own_hold = true,
                     .if_moved = IfMoved::Same};

namespace {
const NodeKind kObeyingWait = [] {
  NodeKind kind = timed::obeying_kind(kWait, tick_wait<true>, timed::pause_paced);
  kind.progress = progress_of_wait<true>;
  kind.taken_up = [](NodeContext& context, NodeIndex self) {
    return context.state<timed::PacedState>(self).factor;
  };
  return kind;
}();
}  // namespace

}  // namespace lockstep::host
