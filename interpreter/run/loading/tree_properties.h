// The properties that a tree file declares: <property name="…">never arm.failure</property>.
#pragma once

#include <vector>

#include "language/document/reporter.h"
#include "language/property/property.h"
#include "tree/definition.h"

namespace lockstep::host {

// Reports what is wrong with them, at its place.
std::vector<Property> tree_properties(const Definition& definition, const Reporter& report);

}  // namespace lockstep::host
