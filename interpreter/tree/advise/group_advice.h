// Warnings and notes about what waits for ever, or longer than it seems. None of them is sure: what
// is sure is an error of check_groups.
#pragma once

#include "language/document/reporter.h"
#include "tree/definition.h"

namespace lockstep::host {

// Warns of nodes that hold each other in a circle: tree/advise/holding_circle.h.
void warn_of_circle(const Definition& definition, const Reporter& report);

// Warns of members of a pool that keep what others need which they are held for.
void warn_of_keepers(const Definition& definition, const Reporter& report);

// Notes pools whose members are held, so that their turn may never come.
void note_unfairness(const Definition& definition, const Reporter& report);

// Notes members of barriers that a decorator, a branch or a script may keep from running for ever,
// and those that a barrier leaves out after a failure.
void note_idle_members(const Definition& definition, const Reporter& report);

}  // namespace lockstep::host
