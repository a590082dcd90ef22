// Warnings and notes about what waits for ever, or longer than it seems. None of them is sure: what
// is sure is an error of check_groups.
#pragma once

#include "definition/definition.h"
#include "document/reporter.h"

namespace lockstep {

// Warns of nodes that hold each other in a circle: definition/holding_circle.h.
void warn_of_circle(const Definition& definition, const Reporter& report);

}  // namespace lockstep
