// IfThenElse and WhileDoElse: the first child is a condition that chooses one of the others. Of a
// condition that is skipped, and of one that goes on to be asked, there are two rules.
#pragma once

#include "engine/node_context.h"
#include "engine/nodes/fold.h"

namespace lockstep::host::branches {

// Strict: a skipped condition is a fault, and one that has completed is asked again as it is.
enum class Rule : bool { Plain, Strict };

struct BranchState {
  NodeIndex branch;  // that was chosen in this activation; 0: none yet
};

// The result of a branch. All children are reset, also when it was skipped.
inline Status tick_branch(NodeContext& context, NodeIndex self, NodeIndex branch) {
  const Status status = context.tick(branch);
  if (status == Status::Skipped) context.forget_range(self + 1, context.end_of(self));
  return status;
}

inline NodeIndex condition_of(NodeIndex self) {
  return self + 1;
}
inline NodeIndex then_of(NodeContext& context, NodeIndex self) {
  return context.end_of(condition_of(self));
}
// 0: the node has none.
inline NodeIndex else_of(NodeContext& context, NodeIndex self) {
  const NodeIndex branch = context.end_of(then_of(context, self));
  return branch == context.end_of(self) ? 0 : branch;
}

// Without an answer there is no branch.
template <Rule kRule>
Status skipped_condition(NodeContext& context, NodeIndex self) {
  context.halt_running_children(self);
  if (kRule == Rule::Plain) return Status::Skipped;
  context.set_fault(self, "its condition was skipped, so no branch can be chosen");
  return Status::Failure;
}

template <Rule kRule>
Status tick_if(NodeContext& context, NodeIndex self) {
  BranchState& state = context.state<BranchState>(self);
  if (context.first_tick(self)) state.branch = 0;
  if (state.branch == 0) {
    const Status condition = context.tick(condition_of(self));
    if (condition == Status::Running) return condition;
    if (condition == Status::Skipped) return skipped_condition<kRule>(context, self);
    const bool holds = condition == Status::Success;
    state.branch = holds ? then_of(context, self) : else_of(context, self);
    if (state.branch == 0) return Status::Failure;
  }
  return tick_branch(context, self, state.branch);
}

// The condition is asked in every tick; by the strict rule, it is not reset while a branch runs.
template <Rule kRule>
Status ask(NodeContext& context, NodeIndex self) {
  const NodeIndex condition = condition_of(self);
  const bool is_kept =
      kRule == Rule::Strict && !context.first_tick(self) && is_complete(context.status(condition));
  return is_kept ? context.tick_unreset(condition) : context.tick(condition);
}

template <Rule kRule>
Status tick_while(NodeContext& context, NodeIndex self) {
  BranchState& state = context.state<BranchState>(self);
  if (context.first_tick(self)) state.branch = 0;
  const Status condition = ask<kRule>(context, self);
  if (condition == Status::Running) {
    if (kRule == Rule::Plain && state.branch != 0) context.halt(state.branch);
    return condition;
  }
  if (condition == Status::Skipped) return skipped_condition<kRule>(context, self);
  const bool holds = condition == Status::Success;
  const NodeIndex branch = holds ? then_of(context, self) : else_of(context, self);
  if (state.branch != 0 && state.branch != branch) context.halt(state.branch);
  state.branch = branch;
  return branch == 0 ? Status::Failure : tick_branch(context, self, branch);
}

// By the strict rule, a branch may still run while the condition does.
inline double progress_of_branch(NodeContext& context, NodeIndex self) {
  const NodeIndex branch = context.state<BranchState>(self).branch;
  const bool is_asking = context.status(condition_of(self)) == Status::Running;
  return branch == 0 || is_asking ? 0.0 : context.progress(branch);
}

template <Rule kRule>
constexpr NodeKind kIf{
    .type =
        {.id = "IfThenElse",
         .category = NodeCategory::Control,
         .doc =
             "Ticks its first child until it completes, then the second if it succeeded, otherwise "
             "the third. The result is that of the branch; Failure without a third child.",
         .arity = {2, 3},
         .begins_child_once = kRule == Rule::Plain,
         .has_branches = true},
    .tick = tick_if<kRule>,
    .progress = progress_of_branch,
    .state_size = sizeof(BranchState),
    .fold = fold::dead_when_idle,
    .if_moved = IfMoved::FromChild};

template <Rule kRule>
constexpr NodeKind kWhile{.type = {.id = "WhileDoElse",
                                   .category = NodeCategory::Control,
                                   .doc = "Ticks its first child in every tick: while it succeeds, "
                                          "ticks the second child, otherwise the third. The branch "
                                          "that is left is halted. Failure without a third child.",
                                   .arity = {2, 3},
                                   .keeps_first_child = kRule == Rule::Strict,
                                   .has_branches = true},
                          .tick = tick_while<kRule>,
                          .progress = progress_of_branch,
                          .state_size = sizeof(BranchState),
                          .fold = fold::dead_when_idle,
                          .passes_over_branches = kRule == Rule::Strict,
                          .if_moved = IfMoved::FromChild};

}  // namespace lockstep::host::branches
