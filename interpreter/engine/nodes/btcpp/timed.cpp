// Sleep, Delay and Timeout of BehaviorTree.CPP: what is due happens in the first tick at or after
// its time. Time goes on while a node is held.
#include <algorithm>

#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep::btcpp {
namespace {

constexpr unsigned kTime = 0;  // in each of the kinds

constexpr Parameter kSleepParameters[] = {{.name = "msec",
                                           .type = ValueType::Int,
                                           .doc = "How long to sleep.",
                                           .required = true,
                                           .unit = "ms",
                                           .range = {.min = 0, .max = 1e12}}};
constexpr Parameter kDelayParameters[] = {{.name = "delay_msec",
                                           .type = ValueType::Int,
                                           .doc = "How long to wait before the child is ticked.",
                                           .required = true,
                                           .unit = "ms",
                                           .range = {.min = 0, .max = 1e12}}};
constexpr Parameter kTimeoutParameters[] = {{.name = "msec",
                                             .type = ValueType::Int,
                                             .doc = "How long the child may run; 0: for ever.",
                                             .required = true,
                                             .unit = "ms",
                                             .range = {.min = 0, .max = 1e12}}};

Nanoseconds time_of(const Ticker& ticker, NodeIndex self) {
  return std::chrono::milliseconds(ticker.parameter(self, kTime).integer);
}

// Kept while the child is skipped, so not cleared by a first tick.
struct TimedState {
  Nanoseconds start;
  bool started;  // the time is counted
  bool over;     // it was over once
};

Nanoseconds begin(Ticker& ticker, TimedState& state) {
  if (!state.started) state = {ticker.now(), true, false};
  return ticker.now() - state.start;
}

void forget_timed(Ticker& ticker, NodeIndex self) {
  ticker.state<TimedState>(self) = {};
}

// A start relative to now. If no entry changes the time, at most that has passed.
Nanoseconds folded(Ticker& ticker, NodeIndex self, Nanoseconds start) {
  const Nanoseconds passed = ticker.now() - start;
  const bool is_constant = ticker.has_constant_parameters(self);
  return -(is_constant ? std::min(passed, time_of(ticker, self)) : passed);
}

void fold_sleep(Ticker& ticker, NodeIndex self) {
  fold::dead_when_idle(ticker, self);
  if (ticker.status(self) != Status::Running) return;
  Nanoseconds& start = ticker.state<TimedState>(self).start;
  start = folded(ticker, self, start);
}

void fold_timed(Ticker& ticker, NodeIndex self) {
  TimedState& state = ticker.state<TimedState>(self);
  const bool counts = state.started && !state.over;
  state.start = counts ? folded(ticker, self, state.start) : Nanoseconds(0);
}

Status tick_sleep(Ticker& ticker, NodeIndex self) {
  Nanoseconds& start = ticker.state<TimedState>(self).start;
  if (ticker.first_tick(self)) start = ticker.now();
  return ticker.now() - start >= time_of(ticker, self) ? Status::Success : Status::Running;
}

double progress_of_sleep(Ticker& ticker, NodeIndex self) {
  const Nanoseconds elapsed = ticker.now() - ticker.state<TimedState>(self).start;
  return std::min(1.0, to_seconds(elapsed) / to_seconds(time_of(ticker, self)));
}

Status tick_delay(Ticker& ticker, NodeIndex self) {
  TimedState& state = ticker.state<TimedState>(self);
  const Nanoseconds waited = begin(ticker, state);
  if (!state.over && waited < time_of(ticker, self)) return Status::Running;
  state.over = true;
  const Status status = ticker.tick(self + 1);
  if (is_complete(status)) state = {};
  return status;
}

// A child that begins after the time is over runs as long as it likes.
Status tick_timeout(Ticker& ticker, NodeIndex self) {
  TimedState& state = ticker.state<TimedState>(self);
  const Nanoseconds waited = begin(ticker, state);
  const Nanoseconds limit = time_of(ticker, self);
  if (!state.over && limit > Nanoseconds(0) && waited >= limit) {
    state.over = true;
    if (ticker.status(self + 1) == Status::Running) {
      ticker.halt(self + 1);
      state = {};
      return Status::Failure;
    }
  }
  const Status status = ticker.tick(self + 1);
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
                                 .parameters = kTimeoutParameters},
                        .tick = tick_timeout,
                        .progress = decorator::child_progress,
                        .state_size = sizeof(TimedState),
                        .halt = forget_timed,
                        .forget = forget_timed,
                        .fold = fold_timed};

}  // namespace lockstep::btcpp
