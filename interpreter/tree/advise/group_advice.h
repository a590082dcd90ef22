// Notes about members of barriers and pools, and about who would need one. Deadlocks are found by
// running the tree: verify/advice.h; those that are sure are errors of check_groups.
#pragma once

#include "language/document/reporter.h"
#include "tree/definition.h"

namespace lockstep::host {

// Notes pools whose members are held, so that their turn may never come.
void note_unfairness(const Definition& definition, const Reporter& report);

// Notes members that a barrier with idle="ignore" leaves out after a failure, until they begin
// again. Warns of a barrier at 0 there.
void note_openings(const Definition& definition, const Reporter& report);

// Notes actions of one device that overlap for a tick, where a pool would keep them apart.
void note_handovers(const Definition& definition, const Reporter& report);

// Notes nodes with hold="between" that hold no Sequence.
void note_unused_holds(const Definition& definition, const Reporter& report);

}  // namespace lockstep::host
