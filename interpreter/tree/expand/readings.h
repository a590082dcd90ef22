// Finds the nodes and the resources that scripts read (Expression::readings).
#pragma once

#include <string_view>

#include "language/document/reporter.h"
#include "language/expression/reading.h"
#include "tree/definition.h"

namespace lockstep::host {

// The name that may be one of a barrier or a pool; "" of owner(dock), which names a resource alone.
std::string_view group_in(const Reading& reading);

// A script in a SubTree means a node of the same SubTree if one has that name, else one of the tree
// around it. Example: with two <SubTree ID="Truck"/>, the status(dig) in each is that of its own.
// After resolve_resources.
void resolve_readings(Definition& definition, const Reporter& report);

}  // namespace lockstep::host
