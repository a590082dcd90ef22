#include "engine/nodes/decorator.h"
#include "engine/nodes/timed.h"

namespace lockstep::host {
namespace {

constexpr Parameter kTimeoutParameters[] = {
    {.name = "seconds",
     .type = ValueType::Double,
     .doc = "How long the child may run, counted from its first tick.",
     .required = true,
     .unit = "s",
     .range = {.min = 0, .max = 1e9, .min_excluded = true}},
    timed::kClockParameter,
};

template <bool kObeys>
Status tick_timeout(NodeContext& context, NodeIndex self) {
  if (!timed::is_over_by_clock<kObeys>(context, self)) return context.tick(self + 1);
  context.halt(self + 1);
  return Status::Failure;
}

extern const NodeKind kObeyingTimeout;

}  // namespace

const NodeKind kTimeout{
    .type = {.id = "Timeout",
             .category = NodeCategory::Decorator,
             .doc = "Halts its child and returns Failure if the child still runs after a time.",
             .arity = {1, 1},
             .parameters = kTimeoutParameters,
             .begins_child_once = true,
             .limits_time = true},
    .tick = tick_timeout<false>,
    .progress = decorator::child_progress,
    .state_size = sizeof(timed::State),
    .pause = timed::pause,
    .fold = timed::fold_by_clock,
    .obeying = &kObeyingTimeout,
    .reads_own_hold = true,
    .if_moved = IfMoved::Same};

namespace {
const NodeKind kObeyingTimeout = timed::obeying_kind(kTimeout, tick_timeout<true>);
}  // namespace

}  // namespace lockstep::host
