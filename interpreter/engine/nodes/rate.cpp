#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/timed.h"

namespace lockstep::host {
namespace {

constexpr Parameter kRateParameters[] = {
    timed::seconds("The least time from one start of the child to the next."),
    timed::kClockParameter,
};

// Not cleared by a new activation.
struct RateState {
  timed::State time;  // since the child was started
  Status result;      // of the child; Idle: none that counts
};

Status tick_rate(NodeContext& context, NodeIndex self) {
  RateState& state = context.state<RateState>(self);
  const bool starts = context.first_tick(self);
  if (starts && is_complete(state.result) && !timed::is_over(context, self)) return state.result;
  const bool goes_on = context.parameter(self, timed::kClock).integer == timed::kWall;
  if (starts || !goes_on) timed::count(context, self);
  const Status status = context.tick(self + 1);
  state.result = is_complete(status) ? status : Status::Idle;
  return status;
}

void fold_rate(NodeContext& context, NodeIndex self) {
  if (context.status(self) == Status::Running) return timed::fold_by_clock(context, self);
  RateState& state = context.state<RateState>(self);
  const bool is_over = context.parameters().are_fixed(self) && timed::is_over(context, self);
  if (!is_complete(state.result) || is_over) return fold::dead(context, self);
  state.time = {.start = -context.passed(state.time.start), .paused_at = Nanoseconds(0)};
}

}  // namespace

const NodeKind kRate{
    .type = {.id = "Rate",
             .category = NodeCategory::Decorator,
             .doc = "Starts its child at most once in a time; in between returns its last result "
                    "without ticking it. A child that runs is ticked in every tick.",
             .arity = {1, 1},
             .parameters = kRateParameters,
             .again = Again::ReturnsResult},
    .tick = tick_rate,
    .progress = decorator::child_progress,
    .state_size = sizeof(RateState),
    .pause = timed::pause,
    .fold = fold_rate,
    .reads_own_hold = true,
    .if_moved = IfMoved::Same};

}  // namespace lockstep::host
