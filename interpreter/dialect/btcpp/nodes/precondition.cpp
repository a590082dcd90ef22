#include "dialect/btcpp/nodes/kinds.h"
#include "dialect/btcpp/nodes/results.h"
#include "engine/node_scripts.h"
#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep::host::btcpp {
namespace {

constexpr unsigned kIf = 0, kElse = 1;

constexpr Parameter kPreconditionParameters[] = {
    {.name = "if",
     .type = ValueType::String,
     .doc = "The script that decides, in each tick until the child is started.",
     .required = true,
     .is_script = true},
    {.name = "else",
     .type = ValueType::String,
     .doc = "The result as long as the script is false.",
     .default_text = "FAILURE",
     .choices = kResults},
};

struct PreconditionState {
  bool is_open;  // the script was true, and the child has not completed since
};

Status otherwise(const NodeContext& context, NodeIndex self) {
  return static_cast<Status>(context.parameter(self, kElse).integer + 1);
}

Status tick_precondition(NodeContext& context, NodeIndex self) {
  PreconditionState& state = context.state<PreconditionState>(self);
  if (!state.is_open) {
    const auto holds = context.scripts().holds(self, kIf);
    if (!holds) return Status::Failure;
    if (!*holds) return otherwise(context, self);
  }
  state.is_open = true;
  const Status status = context.tick(self + 1);
  if (is_complete(status)) state.is_open = false;
  return status;
}

void forget_precondition(NodeContext& context, NodeIndex self) {
  context.state<PreconditionState>(self).is_open = false;
}

}  // namespace

const NodeKind kPrecondition{
    .type = {.id = "Precondition",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child to its end once a script is true; before that the result is "
                    "'else'.",
             .arity = {1, 1},
             .parameters = kPreconditionParameters,
             .can_run = true},
    .tick = tick_precondition,
    .progress = decorator::child_progress,
    .state_size = sizeof(PreconditionState),
    .halt = forget_precondition,
    .forget = forget_precondition,
    .fold = fold::live};

}  // namespace lockstep::host::btcpp
