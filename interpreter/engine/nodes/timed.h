// The time that Wait, Timeout and Delay count: since the first tick of an activation, and without
// the time during which the node was held.
#pragma once

#include <algorithm>

#include "engine/nodes/fold.h"

namespace lockstep::host::timed {

inline constexpr unsigned kSeconds = 0;
inline constexpr unsigned kClock = 1;  // not of Wait

constexpr Parameter seconds(std::string_view doc) {
  return {.name = "seconds",
          .type = ValueType::Double,
          .doc = doc,
          .required = true,
          .unit = "s",
          .range = {.min = 0, .max = 1e9}};
}

// For what waits for something else. The cell of one that is absent is 0.
inline constexpr Parameter kLongestWait{
    .name = "timeout",
    .type = ValueType::Double,
    .doc =
        "How long to wait at most, without the time during which it is held; without limit when "
        "absent.",
    .unit = "s",
    .range = {.min = 0, .max = 1e9, .min_excluded = true}};

inline constexpr std::string_view kClocks[] = {"active", "wall"};
inline constexpr std::int64_t kWall = 1;
inline constexpr Parameter kClockParameter{
    .name = "clock",
    .type = ValueType::String,
    .doc =
        "Which time counts: active stops while the node is held; wall continues, and what is due "
        "happens in the next tick that the node receives.",
    .default_text = "active",
    .choices = kClocks};

struct State {
  Nanoseconds start;
  Nanoseconds paused_at;
};

inline void pause(NodeContext& context, NodeIndex self) {
  context.state<State>(self).paused_at = context.now();
}

// Below a node that paces: what passes counts by the factor that was given in the last tick.
struct PacedState {
  State times;
  Nanoseconds last;  // tick
  double factor;
};

inline Nanoseconds lost(const PacedState& state, Nanoseconds now) {
  return from_seconds((1.0 - state.factor) * to_seconds(now - state.last));
}

inline void pause_paced(NodeContext& context, NodeIndex self) {
  auto& state = context.state<PacedState>(self);
  pause(context, self);
  state.times.start += lost(state, context.now());
}

// Call once in each tick, before anything else.
template <bool kObeys = false>
void count(NodeContext& context, NodeIndex self) {
  State& state = context.state<State>(self);
  const bool is_paused = context.activity(self) == Activity::Paused;
  const bool begins = context.first_tick(self);
  if (begins) state.start = context.now();
  if (is_paused) state.start += context.now() - state.paused_at;
  if constexpr (kObeys) {
    auto& paced = context.state<PacedState>(self);
    if (!begins && !is_paused) state.start += lost(paced, context.now());
    paced.last = context.now();
    paced.factor = factor_of(context.pace());
  }
}

// In this tick; also for a node that is held.
template <bool kObeys = false>
Nanoseconds counted(NodeContext& context, NodeIndex self) {
  const State& state = context.state<State>(self);
  const bool is_paused = context.activity(self) == Activity::Paused;
  Nanoseconds start = state.start;
  if constexpr (kObeys) {
    if (!is_paused) start += lost(context.state<PacedState>(self), context.now());
  }
  return context.passed(start, is_paused ? state.paused_at : context.now());
}

inline bool is_over(NodeContext& context, NodeIndex self) {
  return context.passed(context.state<State>(self).start) >=
         from_seconds(context.parameter(self, kSeconds).number);
}

// For a kLongestWait.
inline bool has_waited(NodeContext& context, NodeIndex self) {
  return context.parameter(self, kSeconds).number != 0 && is_over(context, self);
}

// Makes the times of a running node relative to now. If no entry changes what is counted, it is at
// most `limit`.
inline void count_from_now(NodeContext& context, NodeIndex self, bool stands_while_held,
                           Nanoseconds limit) {
  State& state = context.state<State>(self);
  const bool is_paused = context.activity(self) == Activity::Paused;
  if (!context.parameters().are_fixed(self)) {
    state.start = -context.passed(state.start);
    state.paused_at = is_paused ? -context.passed(state.paused_at) : Nanoseconds(0);
    return;
  }
  const Nanoseconds until = is_paused && stands_while_held ? state.paused_at : context.now();
  const Nanoseconds most = context.deadlines().at_least(limit);
  state = {.start = -std::min(context.passed(state.start, until), most),
           .paused_at = Nanoseconds(0)};
}

// For Wait.
inline void fold(NodeContext& context, NodeIndex self) {
  fold::dead_when_idle(context, self);
  if (context.status(self) != Status::Running) return;
  count_from_now(context, self, true, from_seconds(context.parameter(self, kSeconds).number));
}

// For Timeout, Delay and Rate: with clock="wall" it also counts while the node is held or slowed.
inline bool goes_on(NodeContext& context, NodeIndex self) {
  return context.parameter(self, kClock).integer == kWall;
}

// For Timeout, Delay and a Rate that runs.
inline void fold_by_clock(NodeContext& context, NodeIndex self) {
  fold::dead_when_idle(context, self);
  if (context.status(self) != Status::Running) return;
  count_from_now(context, self, !goes_on(context, self),
                 from_seconds(context.parameter(self, kSeconds).number));
}

// For Timeout and Delay.
template <bool kObeys>
bool is_over_by_clock(NodeContext& context, NodeIndex self) {
  if (!goes_on(context, self) || context.first_tick(self)) count<kObeys>(context, self);
  return is_over(context, self);
}

inline void pause_paced_by_clock(NodeContext& context, NodeIndex self) {
  goes_on(context, self) ? pause(context, self) : pause_paced(context, self);
}

// The same kind below a node that paces.
inline NodeKind obeying_kind(const NodeKind& plain, Status (*tick)(NodeContext&, NodeIndex),
                             void (*pause)(NodeContext&, NodeIndex) = pause_paced_by_clock) {
  NodeKind kind = plain;
  kind.tick = tick;
  kind.state_size = sizeof(PacedState);
  kind.pause = pause;
  kind.obeying = nullptr;
  return kind;
}

}  // namespace lockstep::host::timed
