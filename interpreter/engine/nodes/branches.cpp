// IfThenElse and WhileDoElse: the first child is a condition that chooses one of the others. The
// two languages differ in a condition that is skipped, and in one that goes on to be asked.
#include "engine/node_context.h"
#include "engine/nodes/fold.h"
#include "engine/nodes/kinds.h"

namespace lockstep {
namespace {

struct BranchState {
  NodeIndex branch;  // that was chosen in this activation; 0: none yet
};

// The result of a branch. All children are reset, also when it was skipped.
Status tick_branch(NodeContext& context, NodeIndex self, NodeIndex branch) {
  const Status status = context.tick(branch);
  if (status == Status::Skipped) context.forget_range(self + 1, context.end_of(self));
  return status;
}

NodeIndex condition_of(NodeIndex self) {
  return self + 1;
}
NodeIndex then_of(NodeContext& context, NodeIndex self) {
  return context.end_of(condition_of(self));
}
// 0: the node has none.
NodeIndex else_of(NodeContext& context, NodeIndex self) {
  const NodeIndex branch = context.end_of(then_of(context, self));
  return branch == context.end_of(self) ? 0 : branch;
}

// Without an answer there is no branch.
template <Language kLanguage>
Status skipped_condition(NodeContext& context, NodeIndex self) {
  context.halt_running_children(self);
  if (kLanguage == Language::Lockstep) return Status::Skipped;
  context.set_fault(self, "its condition was skipped, so no branch can be chosen");
  return Status::Failure;
}

template <Language kLanguage>
Status tick_if(NodeContext& context, NodeIndex self) {
  BranchState& state = context.state<BranchState>(self);
  if (context.first_tick(self)) state.branch = 0;
  if (state.branch == 0) {
    const Status condition = context.tick(condition_of(self));
    if (condition == Status::Running) return condition;
    if (condition == Status::Skipped) return skipped_condition<kLanguage>(context, self);
    const bool holds = condition == Status::Success;
    state.branch = holds ? then_of(context, self) : else_of(context, self);
    if (state.branch == 0) return Status::Failure;
  }
  return tick_branch(context, self, state.branch);
}

// The condition is asked in every tick; for BehaviorTree.CPP, it is not reset while a branch runs.
template <Language kLanguage>
Status ask(NodeContext& context, NodeIndex self) {
  const NodeIndex condition = condition_of(self);
  const bool is_kept = kLanguage == Language::BehaviorTreeCpp && !context.first_tick(self) &&
                       is_complete(context.status(condition));
  return is_kept ? context.tick_unreset(condition) : context.tick(condition);
}

template <Language kLanguage>
Status tick_while(NodeContext& context, NodeIndex self) {
  BranchState& state = context.state<BranchState>(self);
  if (context.first_tick(self)) state.branch = 0;
  const Status condition = ask<kLanguage>(context, self);
  if (condition == Status::Running) {
    if (kLanguage == Language::Lockstep && state.branch != 0) context.halt(state.branch);
    return condition;
  }
  if (condition == Status::Skipped) return skipped_condition<kLanguage>(context, self);
  const bool holds = condition == Status::Success;
  const NodeIndex branch = holds ? then_of(context, self) : else_of(context, self);
  if (state.branch != 0 && state.branch != branch) context.halt(state.branch);
  state.branch = branch;
  return branch == 0 ? Status::Failure : tick_branch(context, self, branch);
}

double progress_of_branch(NodeContext& context, NodeIndex self) {
  const NodeIndex branch = context.state<BranchState>(self).branch;
  return branch == 0 ? 0.0 : context.progress(branch);
}

template <Language kLanguage>
constexpr NodeKind kIf{
    .type = {.id = "IfThenElse",
             .category = NodeCategory::Control,
             .doc = "Ticks its first child until it completes, then the second if it succeeded, "
                    "else the third. The result is that of the branch; Failure without a third "
                    "child.",
             .arity = {2, 3},
             .begins_child_once = kLanguage == Language::Lockstep},
    .tick = tick_if<kLanguage>,
    .progress = progress_of_branch,
    .state_size = sizeof(BranchState),
    .fold = fold::dead_when_idle};

template <Language kLanguage>
constexpr NodeKind kWhile{
    .type = {.id = "WhileDoElse",
             .category = NodeCategory::Control,
             .doc = "Asks its first child in every tick: while it succeeds, ticks the second "
                    "child, else the third. The branch that is left is halted. Failure without a "
                    "third child.",
             .arity = {2, 3}},
    .tick = tick_while<kLanguage>,
    .progress = progress_of_branch,
    .state_size = sizeof(BranchState),
    .fold = fold::dead_when_idle};

}  // namespace

const NodeKind kIfThenElse = kIf<Language::Lockstep>;
const NodeKind kWhileDoElse = kWhile<Language::Lockstep>;
const NodeKind btcpp::kIfThenElse = kIf<Language::BehaviorTreeCpp>;
const NodeKind btcpp::kWhileDoElse = kWhile<Language::BehaviorTreeCpp>;

}  // namespace lockstep
