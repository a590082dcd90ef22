#include "engine/nodes/run_once.h"

#include "engine/nodes/decorator.h"
#include "engine/nodes/fold.h"

namespace lockstep::host {

const NodeKind kRunOnce{
    .type = {.id = "RunOnce",
             .category = NodeCategory::Decorator,
             .doc = "Ticks its child until it has completed once in this run; from then on returns "
                    "that result without ticking it.",
             .arity = {1, 1},
             .again = Again::ReturnsResult,
             .begins_child_once = true},
    .tick = run_once::tick,
    .progress = decorator::child_progress,
    .state_size = sizeof(run_once::State),
    .fold = fold::live,
    .if_moved = IfMoved::Same};

}  // namespace lockstep::host
