#include "engine/nodes/decorator.h"
#include "engine/nodes/timed.h"

namespace lockstep::host {
namespace {

constexpr Parameter kDelayParameters[] = {
    timed::seconds("How long to wait before the child is ticked."),
    timed::kClockParameter,
};

template <bool kObeys>
Status tick_delay(NodeContext& context, NodeIndex self) {
  return timed::is_over_by_clock<kObeys>(context, self) ? context.tick(self + 1) : Status::Running;
}

extern const NodeKind kObeyingDelay;

}  // namespace

const NodeKind kDelay{
    .type = {.id = "Delay",
             .category = NodeCategory::Decorator,
             .doc = "Running for a time, then ticks its child and returns what it returns.",
             .arity = {1, 1},
             .parameters = kDelayParameters,
             .begins_child_once = true,
             .can_run = true},
    .tick = tick_delay<false>,
    .progress = decorator::child_progress,
    .state_size = sizeof(timed::State),
    .pause = timed::pause,
    .fold = timed::fold_by_clock,
    .obeying = &kObeyingDelay,
    .reads_own_hold = true,
    .if_moved = IfMoved::Same};

namespace {
const NodeKind kObeyingDelay = timed::obeying_kind(kDelay, tick_delay<true>);
}  // namespace

}  // namespace lockstep::host
