#include "engine/nodes/fold.h"
#include "engine/nodes/kinds.h"
#include "engine/nodes/ordered.h"

namespace lockstep {
const NodeKind kFallback{
    .type = {.id = "Fallback",
             .category = NodeCategory::Control,
             .doc = "Ticks its children from the left, every tick from the first; stops at the "
                    "first that is Running or Success and returns that. Failure when all fail.",
             .arity = {1},
             .parameters = ordered::kParameters,
             .sign = "?",
             .goes_on_after = Status::Failure},
    .tick = ordered::tick<Status::Failure>,
    .progress = ordered::progress_of_fallback,
    .state_size = sizeof(ordered::State),
    .fold = fold::dead_when_idle};

}  // namespace lockstep
