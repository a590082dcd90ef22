// The common tick of Sequence, Fallback and their reactive forms: tick children from the left and
// stop at the first that does not return `kGoOn`. A child that is skipped counts as not there.
#pragma once

#include <cstdint>

#include "engine/leaf_loop.h"
#include "engine/nodes/fold.h"
#include "engine/synchronized.h"

namespace lockstep::host::ordered {

struct State {
  NodeIndex current;      // the child at which the last tick stopped
  std::uint32_t done;     // how many children are before it
  std::uint32_t skipped;  // of those
};

inline constexpr Parameter kParameters[] = {
    {.name = "memory",
     .type = ValueType::Bool,
     .doc = "Do not tick again the children that already completed in this activation.",
     .default_text = "false",
     .constant = true},
};

// Whether children that have completed are ticked again.
enum class Memory : std::uint8_t { ByParameter, Always, Never };

template <Memory kMemory>
bool has_memory(const NodeContext& context, NodeIndex self) {
  if constexpr (kMemory == Memory::ByParameter) return context.parameter(self, 0).boolean;
  return kMemory == Memory::Always;
}

// How many children there are from one child up to another.
inline std::uint32_t count(const NodeContext& context, NodeIndex self, NodeIndex from,
                           NodeIndex to) {
  const Node& it = context.node(self);
  if (it.end - self - 1 == it.children) return to - from;  // all of them are leaves
  std::uint32_t children = 0;
  for (; from != to; from = context.end_of(from)) ++children;
  return children;
}

template <Status kGoOn, Memory kMemory>
Status tick(NodeContext& context, NodeIndex self) {
  State& state = context.state<State>(self);
  const NodeIndex end = context.end_of(self);
  const bool resume = !context.first_tick(self) && has_memory<kMemory>(context, self);
  const NodeIndex begin = resume ? state.current : self + 1;
  std::uint32_t skipped = resume ? state.skipped : 0;
  for (NodeIndex next = begin; next != end;) {
    NodeIndex child = next;
    Status status = Status::Idle;
    if (LeafLoop::begins_at(context, child)) {
      const LeafLoop::Stop stop = LeafLoop::tick<kGoOn>(context, child, end);
      if (stop.child == end) break;
      child = stop.child;
      next = context.end_of(child);
      status = stop.status != Status::Idle ? stop.status : context.tick_apart(child);
    } else {
      next = context.end_of(child);
      status = context.tick(child);
    }
    if (status == kGoOn) continue;
    if (status == Status::Skipped) {
      if (!has_memory<kMemory>(context, self)) context.forget_range(child, next);
      ++skipped;
      continue;
    }
    const NodeIndex previous = context.first_tick(self) ? self : state.current;
    if (child < previous) context.halt_range(next, context.end_of(previous));
    const std::uint32_t done = resume ? state.done : 0;
    state = {child, done + count(context, self, begin, child), skipped};
    return status;
  }
  if (skipped != context.node(self).children) return kGoOn;
  context.forget_range(self + 1, end);
  return Status::Skipped;
}

// The same below a node with hold="between". Before a Sequence begins a child, it looks whether it
// is held there: not before its first one, nor before those that it has been at already.
template <Status kGoOn, Memory kMemory>
Status tick_between(NodeContext& context, NodeIndex self) {
  State& state = context.state<State>(self);
  const NodeIndex end = context.end_of(self);
  const NodeIndex previous = context.first_tick(self) ? self + 1 : state.current;
  const bool resume = !context.first_tick(self) && has_memory<kMemory>(context, self);
  if (!resume) state = {self + 1, 0, 0};
  for (NodeIndex child = resume ? previous : self + 1; child != end; ++state.done) {
    state.current = child;
    if (kGoOn == Status::Success && child > previous && is_limit_reached(context, self))
      return Status::Running;
    const NodeIndex next = context.end_of(child);
    const Status status = context.tick(child);
    if (status != kGoOn && status != Status::Skipped) {
      if (child < previous) context.halt_range(next, context.end_of(previous));
      return status;
    }
    if (status == Status::Skipped) {
      if (!has_memory<kMemory>(context, self)) context.forget_range(child, next);
      ++state.skipped;
    }
    child = next;
  }
  if (state.skipped != context.node(self).children) return kGoOn;
  context.forget_range(self + 1, end);
  return Status::Skipped;
}

inline double progress_of_sequence(NodeContext& context, NodeIndex self) {
  const auto& state = context.state<State>(self);
  return (state.done + context.progress(state.current)) / context.node(self).children;
}

inline double progress_of_fallback(NodeContext& context, NodeIndex self) {
  return context.progress(context.state<State>(self).current);
}

// The row of a kind.
template <Status kGoOn, Memory kMemory>
constexpr NodeKind kind(std::string_view id, std::string_view doc) {
  constexpr bool kIsSequence = kGoOn == Status::Success;
  constexpr auto kShare = kIsSequence ? ProgressShare::EachChild : ProgressShare::NotByPlace;
  NodeKind kind{.type = {.id = id,
                         .category = NodeCategory::Control,
                         .doc = doc,
                         .arity = {1},
                         .sign = kIsSequence ? "→" : "?",
                         .progress_share = kShare,
                         .goes_on_after = kGoOn,
                         .is_reactive = kMemory == Memory::Never},
                .tick = tick<kGoOn, kMemory>,
                .progress = kIsSequence ? progress_of_sequence : progress_of_fallback,
                .state_size = sizeof(State),
                .fold = fold::dead_when_idle,
                .tick_between = tick_between<kGoOn, kMemory>,
                .if_moved = IfMoved::FromChild};
  if (kMemory == Memory::ByParameter) kind.type.parameters = kParameters;
  return kind;
}

}  // namespace lockstep::host::ordered
