// The last part of what `lockstep check` says of a tree, for all who say the same.
#pragma once

#include <functional>

#include "base/core/diagnostics.h"
#include "language/document/project.h"
#include "tree/definition.h"

namespace lockstep::host {

// Adds what a short search over all behaviors of the tree is sure of. Plugins are not called. A
// project with arguments is left out: other arguments make another tree.
// Adds nothing once `stop_signal` returns something else than 0.
void add_certainties(const Project& project, Definition definition, Diagnostics& diagnostics,
                     std::function<int()> stop_signal = {});

}  // namespace lockstep::host
