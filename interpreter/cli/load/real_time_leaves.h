// Leaves that work in real time, on a clock on which no tick waits for them.
#pragma once

#include <string>

#include "base/core/diagnostics.h"
#include "engine/tree.h"

namespace lockstep::host {

// For a run on the virtual clock: warns, once, of all such leaves of the tree. True if there are
// any.
bool warn_of_real_time_leaves(const Tree& tree, const std::string& file, const std::string& hint,
                              Diagnostics& diagnostics);

}  // namespace lockstep::host
