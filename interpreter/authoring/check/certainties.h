// The last part of what `lockstep check` says of a tree, for all who say the same.
#pragma once

#include "core/diagnostics.h"
#include "definition/definition.h"
#include "document/project.h"

namespace lockstep::host {

// Adds what a short search over all behaviors of the tree is sure of. Plugins are not called. A
// project with arguments is left out: other arguments make another tree.
void add_certainties(const Project& project, Definition definition, Diagnostics& diagnostics);

}  // namespace lockstep::host
