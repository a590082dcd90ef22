// The properties that a tree file declares: <property name="…">never arm.failure</property>.
#pragma once

#include <vector>

#include "base/core/diagnostics.h"
#include "language/document/project.h"
#include "language/property/property.h"
#include "tree/definition.h"

namespace lockstep::host {

// Those of the main file. What a file that it includes says of its own trees does not count.
// Reports what is wrong with them, at its place.
std::vector<Property> tree_properties(const Project& project, const Definition& definition,
                                      Diagnostics& diagnostics);

}  // namespace lockstep::host
