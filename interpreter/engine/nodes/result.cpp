// Inverter, ForceSuccess, ForceFailure: change the result of their child, nothing else.
#include "engine/nodes/decorator.h"

namespace lockstep::host {
namespace {

template <Status kSuccessBecomes, Status kFailureBecomes>
Status tick_result(NodeContext& context, NodeIndex self) {
  const Status status = context.tick(self + 1);
  if (status == Status::Success) return kSuccessBecomes;
  if (status == Status::Failure) return kFailureBecomes;
  return status;
}

}  // namespace

const NodeKind kInverter{
    .type = {.id = "Inverter",
             .category = NodeCategory::Decorator,
             .doc = "Success of its child becomes Failure, and Failure Success.",
             .arity = {1, 1},
             .begins_child_once = true,
             .inverts = true},
    .tick = tick_result<Status::Failure, Status::Success>,
    .progress = decorator::child_progress};

const NodeKind kForceSuccess{
    .type = {.id = "ForceSuccess",
             .category = NodeCategory::Decorator,
             .doc = "Success when its child completes, whatever the result.",
             .arity = {1, 1},
             .begins_child_once = true},
    .tick = tick_result<Status::Success, Status::Success>,
    .progress = decorator::child_progress};

const NodeKind kForceFailure{
    .type = {.id = "ForceFailure",
             .category = NodeCategory::Decorator,
             .doc = "Failure when its child completes, whatever the result.",
             .arity = {1, 1},
             .begins_child_once = true},
    .tick = tick_result<Status::Failure, Status::Failure>,
    .progress = decorator::child_progress};

}  // namespace lockstep::host
