// IfThenElse and WhileDoElse: the first child is a condition that chooses one of the others.
#include "engine/nodes/kinds.h"
#include "engine/ticker.h"

namespace lockstep::btcpp {
namespace {

struct State {
  NodeIndex branch;  // that was chosen in this activation; 0: none yet
};

// The result of a branch. All children are reset, also when it was skipped.
Status tick_branch(Ticker& ticker, NodeIndex self, NodeIndex branch) {
  const Status status = ticker.tick(branch);
  if (status == Status::Skipped) ticker.forget_range(self + 1, ticker.end_of(self));
  return status;
}

NodeIndex condition_of(NodeIndex self) {
  return self + 1;
}
NodeIndex then_of(Ticker& ticker, NodeIndex self) {
  return ticker.end_of(condition_of(self));
}
// 0: the node has none.
NodeIndex else_of(Ticker& ticker, NodeIndex self) {
  const NodeIndex branch = ticker.end_of(then_of(ticker, self));
  return branch == ticker.end_of(self) ? 0 : branch;
}

Status skipped_condition(Ticker& ticker, NodeIndex self) {
  ticker.set_fault(self, "its condition was skipped, so no branch can be chosen");
  return Status::Failure;
}

Status tick_if(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  if (ticker.first_tick(self)) state.branch = 0;
  if (state.branch == 0) {
    const Status condition = ticker.tick(condition_of(self));
    if (condition == Status::Running) return condition;
    if (condition == Status::Skipped) return skipped_condition(ticker, self);
    const bool holds = condition == Status::Success;
    state.branch = holds ? then_of(ticker, self) : else_of(ticker, self);
    if (state.branch == 0) return Status::Failure;
  }
  return tick_branch(ticker, self, state.branch);
}

// The condition is asked in every tick, and not reset while a branch runs.
Status ask(Ticker& ticker, NodeIndex self) {
  const NodeIndex condition = condition_of(self);
  const bool goes_on = !ticker.first_tick(self) && is_complete(ticker.status(condition));
  return goes_on ? ticker.tick_unreset(condition) : ticker.tick(condition);
}

Status tick_while(Ticker& ticker, NodeIndex self) {
  State& state = ticker.state<State>(self);
  if (ticker.first_tick(self)) state.branch = 0;
  const Status condition = ask(ticker, self);
  if (condition == Status::Running) return condition;
  if (condition == Status::Skipped) {
    ticker.halt_running_children(self);
    return skipped_condition(ticker, self);
  }
  const bool holds = condition == Status::Success;
  const NodeIndex branch = holds ? then_of(ticker, self) : else_of(ticker, self);
  if (state.branch != 0 && state.branch != branch) ticker.halt(state.branch);
  state.branch = branch;
  return branch == 0 ? Status::Failure : tick_branch(ticker, self, branch);
}

double progress(Ticker& ticker, NodeIndex self) {
  const NodeIndex branch = ticker.state<State>(self).branch;
  return branch == 0 ? 0.0 : ticker.progress(branch);
}

}  // namespace

const NodeKind kIfThenElse{
    .type = {.id = "IfThenElse",
             .category = NodeCategory::Control,
             .doc = "Ticks its first child until it completes, then the second if it succeeded, "
                    "else the third. The result is that of the branch; Failure without a third "
                    "child.",
             .arity = {2, 3}},
    .tick = tick_if,
    .progress = progress,
    .state_size = sizeof(State)};

const NodeKind kWhileDoElse{
    .type = {.id = "WhileDoElse",
             .category = NodeCategory::Control,
             .doc = "Asks its first child in every tick: while it succeeds, ticks the second "
                    "child, else the third. The branch that is left is halted. Failure without a "
                    "third child.",
             .arity = {2, 3}},
    .tick = tick_while,
    .progress = progress,
    .state_size = sizeof(State)};

}  // namespace lockstep::btcpp
