// TryCatch: a Sequence of all children but the last, which is ticked after a Failure.
#include "dialect/btcpp/nodes/kinds.h"
#include "engine/nodes/fold.h"

namespace lockstep::host::btcpp {
namespace {

constexpr unsigned kCatchOnHalt = 0;

constexpr Parameter kTryCatchParameters[] = {
    {.name = "catch_on_halt",
     .type = ValueType::Bool,
     .doc = "Tick the last child once when the node is halted while another one runs.",
     .default_text = "false"}};

struct TryCatchState {
  NodeIndex current;
  std::uint32_t done, skipped;
};

NodeIndex last_child(NodeContext& context, NodeIndex self) {
  NodeIndex last = self + 1;
  while (context.end_of(last) != context.end_of(self)) last = context.end_of(last);
  return last;
}

Status tick_last(NodeContext& context, NodeIndex last) {
  const Status status = context.tick(last);
  return status == Status::Running ? status : Status::Failure;
}

Status tick_try_catch(NodeContext& context, NodeIndex self) {
  TryCatchState& state = context.state<TryCatchState>(self);
  const NodeIndex last = last_child(context, self);
  if (context.first_tick(self)) state = {self + 1, 0, 0};
  while (state.current != last) {
    const Status status = context.tick(state.current);
    if (status == Status::Running) return status;
    if (status == Status::Failure) {
      state.current = last;
      return tick_last(context, last);
    }
    if (status == Status::Skipped) ++state.skipped;
    ++state.done;
    state.current = context.end_of(state.current);
    if (state.current != last) continue;
    if (state.skipped != state.done) return Status::Success;
    context.forget_range(self + 1, context.end_of(self));
    return Status::Skipped;
  }
  return tick_last(context, last);
}

void halt_try_catch(NodeContext& context, NodeIndex self) {
  const NodeIndex last = last_child(context, self);
  const bool tries = context.state<TryCatchState>(self).current != last;
  if (!tries || !context.parameter(self, kCatchOnHalt).boolean) return;
  context.halt_range(self + 1, last);
  if (context.faulted()) return;
  if (context.tick(last) == Status::Running) context.halt(last);
}

double progress_of_try_catch(NodeContext& context, NodeIndex self) {
  const auto& state = context.state<TryCatchState>(self);
  const NodeIndex last = last_child(context, self);
  if (state.current == last) return context.progress(last);
  return (state.done + context.progress(state.current)) / (context.node(self).children - 1.0);
}

}  // namespace

const NodeKind kTryCatch{
    .type = {.id = "TryCatch",
             .category = NodeCategory::Control,
             .doc = "Ticks all children but the last as a Sequence. When one fails, ticks the last "
                    "until it completes, and is a Failure.",
             .arity = {2},
             .parameters = kTryCatchParameters,
             .progress_share = ProgressShare::EachButLast},
    .tick = tick_try_catch,
    .progress = progress_of_try_catch,
    .state_size = sizeof(TryCatchState),
    .halt = halt_try_catch,
    .fold = fold::dead_when_idle};

}  // namespace lockstep::host::btcpp
