// The documents of a project as checked trees: the only stage that reads elements and attributes.
#pragma once

#include "core/diagnostics.h"
#include "definition/catalog.h"
#include "definition/checked_tree.h"
#include "document/project.h"

namespace lockstep::host {

// Checks every BehaviorTree of the project, used or not.
CheckedTrees check_trees(const Project& project, const Catalog& catalog, Diagnostics& diagnostics);

}  // namespace lockstep::host
