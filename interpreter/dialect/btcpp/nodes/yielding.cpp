// AsyncSequence, AsyncFallback and SequenceWithMemory: after a child that completed at once, they
// let the tree be ticked again before they go on.
#include "dialect/btcpp/nodes/kinds.h"
#include "engine/nodes/ordered.h"

namespace lockstep::host::btcpp {
namespace {

using ordered::State;  // its place is 0 before the first child

// Whether the place stays when an activation ends without Success, or is halted.
enum class Place : bool { Forgotten, Kept };

void begin(NodeContext& context, NodeIndex self, State& state, Place place) {
  if (!context.first_tick(self)) return;
  if (place == Place::Forgotten || state.current == 0) state = {self + 1, 0, 0};
  state.skipped = 0;
}

// kLooks: below a node with hold="between".
template <Status kGoOn, Place kPlace, bool kLooks>
Status tick_yielding(NodeContext& context, NodeIndex self) {
  State& state = context.state<State>(self);
  begin(context, self, state, kPlace);
  while (state.current != context.end_of(self)) {
    const bool was_idle = context.first_tick(state.current);
    const Status status = context.tick(state.current);
    if (status != kGoOn && status != Status::Skipped) return status;
    if (status == Status::Skipped) ++state.skipped;
    state.current = context.end_of(state.current);
    ++state.done;
    if (state.current == context.end_of(self)) break;
    if (status == kGoOn && was_idle) {
      context.ask_for_another_tick(self);
      return Status::Running;
    }
    if (kLooks && is_limit_reached(context, self)) return Status::Running;
  }
  const bool all_skipped = state.skipped == context.node(self).children;
  state = {};
  if (all_skipped) context.forget_range(self + 1, context.end_of(self));
  return all_skipped ? Status::Skipped : kGoOn;
}

// Its place counts at any time.
void fold_place(NodeContext& context, NodeIndex self) {
  if (context.status(self) != Status::Running) context.state<State>(self).skipped = 0;
}

template <Status kGoOn, Place kPlace>
constexpr NodeKind kind_of_yielding(std::string_view id, std::string_view doc) {
  NodeKind kind = ordered::kind<kGoOn, ordered::Memory::Always>(id, doc);
  kind.type.can_run = true;
  kind.tick = tick_yielding<kGoOn, kPlace, false>;
  kind.tick_between = tick_yielding<kGoOn, kPlace, kGoOn == Status::Success>;
  if (kPlace == Place::Kept) kind.fold = fold_place;
  return kind;
}

}  // namespace

const NodeKind kAsyncSequence = kind_of_yielding<Status::Success, Place::Forgotten>(
    "AsyncSequence",
    "A Sequence that lets the tree be ticked again after a child that succeeds at "
    "once.");

const NodeKind kAsyncFallback = kind_of_yielding<Status::Failure, Place::Forgotten>(
    "AsyncFallback",
    "A Fallback that lets the tree be ticked again after a child that fails at "
    "once.");

const NodeKind kSequenceWithMemory = kind_of_yielding<Status::Success, Place::Kept>(
    "SequenceWithMemory",
    "An AsyncSequence that continues with the child that failed, or was halted, when it is ticked "
    "again.");

}  // namespace lockstep::host::btcpp
