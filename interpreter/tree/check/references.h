// How the trees of a project refer to each other by SubTree.
#pragma once

#include "language/document/reporter.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// Reports references to unknown trees, trees that contain themselves (with the chain), and trees
// that are larger or deeper than kMaxNodes or kMaxDepth once expanded, or whose paths are too long.
// False when a tree contains itself or exceeds a limit: it cannot be expanded then.
bool check_references(const CheckedTrees& trees, const Reporter& report);

}  // namespace lockstep::host
