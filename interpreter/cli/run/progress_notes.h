// Leaves that are in step with others, but say not how far they are.
#pragma once

#include <string>

#include "base/core/diagnostics.h"
#include "engine/tree.h"

namespace lockstep::host {

// Notes each synchronized node whose leaves report no progress, and which these are. `lockstep
// check` has a note at the place of each.
void note_leaves_without_progress(const Tree& tree, const std::string& file,
                                  Diagnostics& diagnostics);

}  // namespace lockstep::host
