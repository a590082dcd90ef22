// The documents of a project as checked trees: the only stage that reads elements and attributes.
#pragma once

#include "base/core/diagnostics.h"
#include "language/document/project.h"
#include "tree/catalog.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// Checks every BehaviorTree of the project, used or not.
CheckedTrees check_trees(const Project& project, const Catalog& catalog, Diagnostics& diagnostics);

}  // namespace lockstep::host
