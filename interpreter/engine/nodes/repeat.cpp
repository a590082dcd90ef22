// Repeat and Retry: the child begins again after one of its results.
#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep::host {
namespace {

constexpr unsigned kTimes = 0;        // or attempts
constexpr std::int64_t kForever = 0;  // the cell of an absent number

constexpr Parameter kRepeatParameters[] = {
    {.name = "times",
     .type = ValueType::Int,
     .doc = "How often the child must succeed; without limit when absent.",
     .range = {.min = 1}},
};

constexpr Parameter kRetryParameters[] = {
    {.name = "attempts",
     .type = ValueType::Int,
     .doc = "How often the child may fail before this node does.",
     .required = true,
     .range = {.min = 1}},
};

struct RepeatState {
  std::int64_t done;  // rounds
};

template <Status kGoOn>
Status tick_repeat(NodeContext& context, NodeIndex self) {
  RepeatState& state = context.state<RepeatState>(self);
  if (context.first_tick(self)) state.done = 0;
  const Status status = context.tick(self + 1);
  if (status != kGoOn) return status;
  ++state.done;
  // An entry may give fewer rounds than are done.
  const std::int64_t times = context.parameter(self, kTimes).integer;
  return times != kForever && state.done >= times ? kGoOn : Status::Running;
}

double progress_of_repeat(NodeContext& context, NodeIndex self) {
  const std::int64_t times = context.parameter(self, kTimes).integer;
  const double child = context.progress(self + 1);
  if (times == kForever) return child;
  // A child that has just succeeded is already counted as done.
  const double current = context.status(self + 1) == Status::Running ? child : 0.0;
  const auto done = static_cast<double>(context.state<RepeatState>(self).done);
  return std::min(1.0, (done + current) / static_cast<double>(times));
}

// How often does not matter for ever.
void fold_repeat(NodeContext& context, NodeIndex self) {
  if (context.parameter(self, kTimes).integer == kForever) return fold::dead(context, self);
  fold::dead_when_idle(context, self);
}

Round round_of_repeat(NodeContext& context, NodeIndex self) {
  return {context.state<RepeatState>(self).done + 1, context.parameter(self, kTimes).integer};
}

}  // namespace

const NodeKind kRepeat{
    .type = {.id = "Repeat",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it has succeeded a number of times, once per tick; "
                    "Failure as soon as it fails.",
             .arity = {1, 1},
             .parameters = kRepeatParameters,
             .progress_share = ProgressShare::EachRound,
             .repeats_after = Status::Success,
             .can_run = true},
    .tick = tick_repeat<Status::Success>,
    .progress = progress_of_repeat,
    .state_size = sizeof(RepeatState),
    .fold = fold_repeat,
    .if_moved = IfMoved::Same,
    .round = round_of_repeat};

const NodeKind kRetry{
    .type = {.id = "Retry",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it succeeds, at most a number of attempts, once per "
                    "tick.",
             .arity = {1, 1},
             .parameters = kRetryParameters,
             .repeats_after = Status::Failure,
             .can_run = true},
    .tick = tick_repeat<Status::Failure>,
    .progress = decorator::child_progress,
    .state_size = sizeof(RepeatState),
    .fold = fold::dead_when_idle,
    .if_moved = IfMoved::Same,
    .round = round_of_repeat};

}  // namespace lockstep::host
