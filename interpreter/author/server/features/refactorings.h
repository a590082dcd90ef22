// Refactorings of the node that is selected, or whose tag the cursor is at, and wrappings of
// several siblings: those after which `lockstep check` finds no new error.
#pragma once

#include <vector>

#include "author/server/features/feature.h"

namespace lockstep::host {

// None if only the editor asks, as for its light bulb, unless it asks for these kinds.
std::vector<Json> refactorings(const Question& question);

}  // namespace lockstep::host
