#include "engine/nodes/run_once.h"

#include "dialect/btcpp/nodes/kinds.h"
#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep::host::btcpp {
namespace {

constexpr unsigned kThenSkip = 0;

constexpr Parameter kRunOnceParameters[] = {
    {.name = "then_skip",
     .type = ValueType::Bool,
     .doc = "Be skipped once the child has completed; otherwise return its result again.",
     .default_text = "true"}};

Status tick_or_skip(NodeContext& context, NodeIndex self) {
  const bool has_run = is_complete(context.state<run_once::State>(self).result);
  const bool skips = has_run && context.parameter(self, kThenSkip).boolean;
  return skips ? Status::Skipped : run_once::tick(context, self);
}

}  // namespace

const NodeKind kRunOnce{
    .type = {.id = "RunOnce",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it has completed once in this run; from then on it is "
                    "skipped, or returns that result again.",
             .arity = {1, 1},
             .parameters = kRunOnceParameters,
             .again = Again::IsSkipped},
    .tick = tick_or_skip,
    .progress = decorator::child_progress,
    .state_size = sizeof(run_once::State),
    .fold = fold::live};

}  // namespace lockstep::host::btcpp
