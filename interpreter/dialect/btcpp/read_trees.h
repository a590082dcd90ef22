// The documents of a project for BehaviorTree.CPP as checked trees.
#pragma once

#include "core/diagnostics.h"
#include "definition/catalog.h"
#include "definition/check/models.h"
#include "definition/checked_tree.h"
#include "document/project.h"

namespace lockstep::host::btcpp {

// Checks every BehaviorTree of the project, used or not.
CheckedTrees read_trees(const Project& project, const Catalog& catalog, const Models& models,
                        Diagnostics& diagnostics);

}  // namespace lockstep::host::btcpp
