// The order in which the documents of a project for BehaviorTree.CPP are read: what a document
// includes comes before it, and a later tree replaces an earlier one with its ID.
#pragma once

#include <cstdint>
#include <vector>

#include "document/project.h"

namespace lockstep::btcpp {

// A document that is included more than once counts at the last of these places.
std::vector<std::uint32_t> document_order(const Project& project);

}  // namespace lockstep::btcpp
