// Sequence, Fallback, ReactiveSequence and ReactiveFallback of BehaviorTree.CPP: the first two keep
// their place, as with memory="true".
#include "engine/nodes/ordered.h"
#include "dialect/btcpp/nodes/kinds.h"
#include "engine/nodes/fold.h"

namespace lockstep::btcpp {

using ordered::Memory;

const NodeKind kSequence{
    .type = {.id = "Sequence",
             .category = NodeCategory::Control,
             .doc = "Ticks its children from the left, going on where it stopped. Running or "
                    "Failure of a child is its result; Success when all succeed.",
             .arity = {1},
             .sign = "→",
             .goes_on_after = Status::Success},
    .tick = ordered::tick<Status::Success, Memory::Always>,
    .progress = ordered::progress_of_sequence,
    .state_size = sizeof(ordered::State),
    .fold = fold::dead_when_idle};

const NodeKind kFallback{
    .type = {.id = "Fallback",
             .category = NodeCategory::Control,
             .doc = "Ticks its children from the left, going on where it stopped. Running or "
                    "Success of a child is its result; Failure when all fail.",
             .arity = {1},
             .sign = "?",
             .goes_on_after = Status::Failure},
    .tick = ordered::tick<Status::Failure, Memory::Always>,
    .progress = ordered::progress_of_fallback,
    .state_size = sizeof(ordered::State),
    .fold = fold::dead_when_idle};

const NodeKind kReactiveSequence{
    .type = {.id = "ReactiveSequence",
             .category = NodeCategory::Control,
             .doc = "Ticks its children from the left, every tick from the first. Running or "
                    "Failure of a child is its result; Success when all succeed. A child that "
                    "still runs behind the one that stopped it is halted.",
             .arity = {1},
             .sign = "→",
             .goes_on_after = Status::Success},
    .tick = ordered::tick<Status::Success, Memory::Never>,
    .progress = ordered::progress_of_sequence,
    .state_size = sizeof(ordered::State),
    .fold = fold::dead_when_idle};

const NodeKind kReactiveFallback{
    .type = {.id = "ReactiveFallback",
             .category = NodeCategory::Control,
             .doc = "Ticks its children from the left, every tick from the first. Running or "
                    "Success of a child is its result; Failure when all fail. A child that still "
                    "runs behind the one that stopped it is halted.",
             .arity = {1},
             .sign = "?",
             .goes_on_after = Status::Failure},
    .tick = ordered::tick<Status::Failure, Memory::Never>,
    .progress = ordered::progress_of_fallback,
    .state_size = sizeof(ordered::State),
    .fold = fold::dead_when_idle};

}  // namespace lockstep::btcpp
