// The documents of a project for BehaviorTree.CPP as checked trees.
#pragma once

#include "base/core/diagnostics.h"
#include "language/document/project.h"
#include "tree/catalog.h"
#include "tree/check/models.h"
#include "tree/checked_tree.h"

namespace lockstep::host::btcpp {

// Checks every BehaviorTree of the project, used or not.
CheckedTrees read_trees(const Project& project, const Catalog& catalog, const Models& models,
                        Diagnostics& diagnostics);

}  // namespace lockstep::host::btcpp
