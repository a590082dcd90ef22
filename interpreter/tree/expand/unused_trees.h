// Trees that the main tree does not use.
#pragma once

#include <string_view>

#include "language/document/reporter.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

// Checks the entries of each of them as if it were the main tree. After expand().
void check_unused(CheckedTrees& trees, std::string_view main, const Reporter& report);

}  // namespace lockstep::host
