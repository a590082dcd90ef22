// Checked trees -> Definition: subtrees expanded into the main tree, keys resolved to entries.
#pragma once

#include "definition/checked_tree.h"
#include "definition/definition.h"
#include "definition/resolve.h"

namespace lockstep {

// `main` is an ID in `trees`, which can be expanded (check_references). What had an error is left
// out, so that the rest is checked too. Takes the values out of `trees`.
Definition expand(const Project& project, CheckedTrees& trees, std::string_view main,
                  const ResolveOptions& options, Diagnostics& diagnostics);

// Warnings and notes about a definition that is legal but probably not what was meant.
void advise(const Project& project, const Definition& definition, Diagnostics& diagnostics);

}  // namespace lockstep
