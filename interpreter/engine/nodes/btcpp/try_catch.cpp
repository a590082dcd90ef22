// TryCatch: a Sequence of all children but the last, which is ticked after a Failure.
#include "engine/nodes/fold.h"
#include "engine/nodes/kinds.h"
#include "engine/ticker.h"

namespace lockstep::btcpp {
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

NodeIndex last_child(Ticker& ticker, NodeIndex self) {
  NodeIndex last = self + 1;
  while (ticker.end_of(last) != ticker.end_of(self)) last = ticker.end_of(last);
  return last;
}

Status tick_last(Ticker& ticker, NodeIndex last) {
  const Status status = ticker.tick(last);
  return status == Status::Running ? status : Status::Failure;
}

Status tick_try_catch(Ticker& ticker, NodeIndex self) {
  TryCatchState& state = ticker.state<TryCatchState>(self);
  const NodeIndex last = last_child(ticker, self);
  if (ticker.first_tick(self)) state = {self + 1, 0, 0};
  while (state.current != last) {
    const Status status = ticker.tick(state.current);
    if (status == Status::Running) return status;
    if (status == Status::Failure) {
      state.current = last;
      return tick_last(ticker, last);
    }
    if (status == Status::Skipped) ++state.skipped;
    ++state.done;
    state.current = ticker.end_of(state.current);
    if (state.current != last) continue;
    if (state.skipped != state.done) return Status::Success;
    ticker.forget_range(self + 1, ticker.end_of(self));
    return Status::Skipped;
  }
  return tick_last(ticker, last);
}

void halt_try_catch(Ticker& ticker, NodeIndex self) {
  const NodeIndex last = last_child(ticker, self);
  const bool tries = ticker.state<TryCatchState>(self).current != last;
  if (!tries || !ticker.parameter(self, kCatchOnHalt).boolean) return;
  ticker.halt_range(self + 1, last);
  if (ticker.faulted()) return;
  if (ticker.tick(last) == Status::Running) ticker.halt(last);
}

double progress_of_try_catch(Ticker& ticker, NodeIndex self) {
  const auto& state = ticker.state<TryCatchState>(self);
  const NodeIndex last = last_child(ticker, self);
  if (state.current == last) return ticker.progress(last);
  return (state.done + ticker.progress(state.current)) / (ticker.node(self).children - 1.0);
}

}  // namespace

const NodeKind kTryCatch{
    .type = {.id = "TryCatch",
             .category = NodeCategory::Control,
             .doc = "Ticks all children but the last as a Sequence. When one fails, ticks the last "
                    "until it completes, and is a Failure.",
             .arity = {2},
             .parameters = kTryCatchParameters},
    .tick = tick_try_catch,
    .progress = progress_of_try_catch,
    .state_size = sizeof(TryCatchState),
    .halt = halt_try_catch,
    .fold = fold::dead_when_idle};

}  // namespace lockstep::btcpp
