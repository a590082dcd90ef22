// Sequence and Fallback.
#include "engine/nodes/ordered.h"

#include "engine/nodes/kinds.h"

namespace lockstep::host {

const NodeKind kSequence = ordered::kind<Status::Success, ordered::Memory::ByParameter>(
    "Sequence",
    "Ticks its children from the left, every tick from the first; stops at the "
    "first that is Running or Failure and returns that. Success when all succeed.");

const NodeKind kFallback = ordered::kind<Status::Failure, ordered::Memory::ByParameter>(
    "Fallback",
    "Ticks its children from the left, every tick from the first; stops at the "
    "first that is Running or Success and returns that. Failure when all fail.");

}  // namespace lockstep::host
