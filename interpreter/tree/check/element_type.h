// The type of one element, where its parameters depend on what it gives to those that are
// constants.
#pragma once

#include "base/core/node_type.h"
#include "language/document/reporter.h"
#include "tree/check/attribute_layout.h"

namespace lockstep::host {

// Null after an error. `type` itself where all its elements are alike, or where the element lacks
// what decides it: then the check of its attributes says so.
const NodeType* type_of_element(const NodeElement& element, const NodeType& type,
                                const Reporter& report);

}  // namespace lockstep::host
