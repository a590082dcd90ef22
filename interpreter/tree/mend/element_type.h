// The type of an element of a text that may be broken.
#pragma once

#include <string_view>

#include "language/document/tolerant.h"
#include "tree/catalog.h"

namespace lockstep::host {

// The type of a node, also of <Action ID="…"/>; null: it is none, or unknown.
const NodeType* type_of(const TolerantTree& tree, const TolerantElement& element,
                        const Catalog& catalog);
const Parameter* parameter_of(const NodeType* type, std::string_view attribute);

}  // namespace lockstep::host
