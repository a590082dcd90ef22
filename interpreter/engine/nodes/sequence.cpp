#include "engine/nodes/fold.h"
#include "engine/nodes/kinds.h"
#include "engine/nodes/ordered.h"

namespace lockstep {
const NodeKind kSequence{
    .type = {.id = "Sequence",
             .category = NodeCategory::Control,
             .doc = "Ticks its children from the left, every tick from the first; stops at the "
                    "first that is Running or Failure and returns that. Success when all succeed.",
             .arity = {1},
             .parameters = ordered::kParameters,
             .sign = "→",
             .goes_on_after = Status::Success},
    .tick = ordered::tick<Status::Success>,
    .progress = ordered::progress_of_sequence,
    .state_size = sizeof(ordered::State),
    .fold = fold::dead_when_idle};

}  // namespace lockstep
