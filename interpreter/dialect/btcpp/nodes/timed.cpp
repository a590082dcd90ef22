// Sleep, Delay and Timeout of BehaviorTree.CPP: what is due happens in the first tick at or after
// its time. Time goes on while a node is held.
#include <algorithm>

#include "dialect/btcpp/nodes/kinds.h"
#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep::host::btcpp {
namespace {

constexpr unsigned kTime = 0;  // in each of the kinds

constexpr Parameter milliseconds(std::string_view name, std::string_view doc) {
  return {.name = name,
          .type = ValueType::Int,
          .doc = doc,
          .required = true,
          .unit = "ms",
          .range = {.min = 0, .max = 1e12}};
}

constexpr Parameter kSleepParameters[] = {milliseconds("msec", "How long to sleep.")};
constexpr Parameter kDelayParameters[] = {
    milliseconds("delay_msec", "How long to wait before the child is ticked.")};
constexpr Parameter kTimeoutParameters[] = {
    milliseconds("msec", "How long the child may run; 0: without limit.")};

Nanoseconds time_of(const NodeContext& context, NodeIndex self) {
  return std::chrono::milliseconds(context.parameter(self, kTime).integer);
}

// Kept while the child is skipped, so not cleared by a first tick.
struct TimedState {
  Nanoseconds start;
  bool started;  // the time is counted
  bool over;     // it was over once
};

Nanoseconds begin(NodeContext& context, TimedState& state) {
  if (!state.started) state = {context.now(), true, false};
  return context.passed(state.start);
}

void forget_timed(NodeContext& context, NodeIndex self) {
  context.state<TimedState>(self) = {};
}

// A start relative to now. If no entry changes the time, at most that has passed.
Nanoseconds folded(NodeContext& context, NodeIndex self, Nanoseconds start) {
  const Nanoseconds passed = context.passed(start);
  const bool is_fixed = context.parameters().are_fixed(self);
  if (!is_fixed) return -passed;
  return -std::min(passed, context.deadlines().at_least(time_of(context, self)));
}

void fold_sleep(NodeContext& context, NodeIndex self) {
  fold::dead_when_idle(context, self);
  if (context.status(self) != Status::Running) return;
  Nanoseconds& start = context.state<TimedState>(self).start;
  start = folded(context, self, start);
}

void fold_timed(NodeContext& context, NodeIndex self) {
  TimedState& state = context.state<TimedState>(self);
  const bool counts = state.started && !state.over;
  state.start = counts ? folded(context, self, state.start) : Nanoseconds(0);
}

Status tick_sleep(NodeContext& context, NodeIndex self) {
  Nanoseconds& start = context.state<TimedState>(self).start;
  if (context.first_tick(self)) start = context.now();
  return context.passed(start) >= time_of(context, self) ? Status::Success : Status::Running;
}

double progress_of_sleep(NodeContext& context, NodeIndex self) {
  const Nanoseconds elapsed = context.passed(context.state<TimedState>(self).start);
  return std::min(1.0, to_seconds(elapsed) / to_seconds(time_of(context, self)));
}

Status tick_delay(NodeContext& context, NodeIndex self) {
  TimedState& state = context.state<TimedState>(self);
  const Nanoseconds waited = begin(context, state);
  if (!state.over && waited < time_of(context, self)) return Status::Running;
  state.over = true;
  const Status status = context.tick(self + 1);
  if (is_complete(status)) state = {};
  return status;
}

// A child that begins after the time is over runs as long as it likes.
Status tick_timeout(NodeContext& context, NodeIndex self) {
  TimedState& state = context.state<TimedState>(self);
  const Nanoseconds waited = begin(context, state);
  const Nanoseconds limit = time_of(context, self);
  if (!state.over && limit > Nanoseconds(0) && waited >= limit) {
    state.over = true;
    if (context.status(self + 1) == Status::Running) {
      context.halt(self + 1);
      state = {};
      return Status::Failure;
    }
  }
  const Status status = context.tick(self + 1);
  if (is_complete(status)) state = {};
  return status;
}

}  // namespace

const NodeKind kSleep{.type = {.id = "Sleep",
                               .category = NodeCategory::Action,
                               .doc = "Running for a time, then Success.",
                               .arity = {0, 0},
                               .parameters = kSleepParameters,
                               .can_run = true},
                      .tick = tick_sleep,
                      .progress = progress_of_sleep,
                      .state_size = sizeof(TimedState),
                      .fold = fold_sleep};

const NodeKind kDelay{.type = {.id = "Delay",
                               .category = NodeCategory::Decorator,
                               .doc = "Running for a time, then ticks its child.",
                               .arity = {1, 1},
                               .parameters = kDelayParameters,
                               .can_run = true},
                      .tick = tick_delay,
                      .progress = decorator::child_progress,
                      .state_size = sizeof(TimedState),
                      .halt = forget_timed,
                      .forget = forget_timed,
                      .fold = fold_timed};

const NodeKind kTimeout{.type = {.id = "Timeout",
                                 .category = NodeCategory::Decorator,
                                 .doc = "Halts its child and fails when it runs for too long.",
                                 .arity = {1, 1},
                                 .parameters = kTimeoutParameters,
                                 .limits_time = true},
                        .tick = tick_timeout,
                        .progress = decorator::child_progress,
                        .state_size = sizeof(TimedState),
                        .halt = forget_timed,
                        .forget = forget_timed,
                        .fold = fold_timed};

}  // namespace lockstep::host::btcpp
