// Files that a project includes by a name: <include path="truck.xml" as="truck"/>.
#pragma once

#include <string>

#include "language/document/project.h"
#include "language/document/reporter.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// Makes the name of each such file stand for its main tree. After all files were read.
void add_named_files(const Project& project, CheckedTrees& trees, const Reporter& report);

// For the second of two trees of one ID.
std::string hint_for_second_tree(const Sources& sources, Place first, Place second);

}  // namespace lockstep::host
