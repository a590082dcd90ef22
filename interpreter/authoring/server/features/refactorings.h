// Refactorings of the node that is selected, or whose tag the cursor is at: those after which
// `lockstep check` finds no new error.
#pragma once

#include <vector>

#include "authoring/server/features/feature.h"

namespace lockstep::host {

// None if the editor asks without being told to, as for its light bulb, unless it asks for them.
std::vector<Json> refactorings(const Question& question);

}  // namespace lockstep::host
