#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/timed.h"

namespace lockstep::host {
namespace {

constexpr Parameter kCooldownParameters[] = {
    timed::seconds("How long the node is skipped after its child has completed."),
};

// Not cleared by a new activation.
struct CooldownState {
  Nanoseconds completed;  // when the child did
  bool cools;
};

bool cools(NodeContext& context, NodeIndex self, const CooldownState& state) {
  const Nanoseconds passed = context.passed(state.completed);
  return state.cools && passed < from_seconds(context.parameter(self, timed::kSeconds).number);
}

Status tick_cooldown(NodeContext& context, NodeIndex self) {
  CooldownState& state = context.state<CooldownState>(self);
  if (cools(context, self, state)) return Status::Skipped;
  const Status status = context.tick(self + 1);
  state = {context.now(), is_complete(status)};
  return status;
}

void fold_cooldown(NodeContext& context, NodeIndex self) {
  CooldownState& state = context.state<CooldownState>(self);
  const bool is_over = context.parameters().are_fixed(self) && !cools(context, self, state);
  if (!state.cools || is_over) return fold::dead(context, self);
  state.completed = -context.passed(state.completed);
}

}  // namespace

const NodeKind kCooldown{
    .type = {.id = "Cooldown",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child; when that has completed, the node is skipped for a time.",
             .arity = {1, 1},
             .parameters = kCooldownParameters,
             .again = Again::IsSkipped},
    .tick = tick_cooldown,
    .progress = decorator::child_progress,
    .state_size = sizeof(CooldownState),
    .fold = fold_cooldown,
    .if_moved = IfMoved::Same};

}  // namespace lockstep::host
