// Sequence, Fallback, ReactiveSequence and ReactiveFallback of BehaviorTree.CPP: the first two keep
// their place, as with memory="true".
#include "engine/nodes/ordered.h"

#include "dialect/btcpp/nodes/kinds.h"

namespace lockstep::host::btcpp {

using ordered::Memory;

const NodeKind kSequence = ordered::kind<Status::Success, Memory::Always>(
    "Sequence",
    "Ticks its children from the left, and continues where it stopped. Running or Failure of a "
    "child is its result; Success when all succeed.");

const NodeKind kFallback = ordered::kind<Status::Failure, Memory::Always>(
    "Fallback",
    "Ticks its children from the left, and continues where it stopped. Running or Success of a "
    "child is its result; Failure when all fail.");

const NodeKind kReactiveSequence = ordered::kind<Status::Success, Memory::Never>(
    "ReactiveSequence",
    "Ticks its children from the left, every tick from the first. Running or "
    "Failure of a child is its result; Success when all succeed. A child that "
    "still runs behind the one that stopped it is halted.");

const NodeKind kReactiveFallback = ordered::kind<Status::Failure, Memory::Never>(
    "ReactiveFallback",
    "Ticks its children from the left, every tick from the first. Running or "
    "Success of a child is its result; Failure when all fail. A child that still "
    "runs behind the one that stopped it is halted.");

}  // namespace lockstep::host::btcpp
