// The order in which documents are read where a later tree replaces an earlier one with its ID:
// what a document includes comes before it.
#pragma once

#include <cstdint>
#include <vector>

#include "language/document/project.h"

namespace lockstep::host {

// A document that is included more than once counts at the last of these places.
std::vector<std::uint32_t> document_order(const Project& project);

}  // namespace lockstep::host
