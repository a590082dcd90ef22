#include "engine/nodes/decorator.h"

namespace lockstep::host {
namespace {

Status tick_keep_running(NodeContext& context, NodeIndex self) {
  return context.tick(self + 1) == Status::Failure ? Status::Failure : Status::Running;
}

}  // namespace

const NodeKind kKeepRunningUntilFailure{
    .type = {.id = "KeepRunningUntilFailure",
             .category = NodeCategory::Decorator,
             .doc = "Running until its child fails; a child that succeeds is started again.",
             .arity = {1, 1},
             .repeats_after = Status::Success,
             .can_run = true},
    .tick = tick_keep_running,
    .progress = decorator::child_progress};

}  // namespace lockstep::host
