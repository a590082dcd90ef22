// The type of one element, where its parameters depend on what it gives to those that are
// constants.
#pragma once

#include "core/node_type.h"
#include "definition/check/attribute_layout.h"
#include "document/reporter.h"

namespace lockstep::host {

// Null after an error. `type` itself where all its elements are alike, or where the element lacks
// what decides it: then the check of its attributes says so.
const NodeType* type_of_element(const NodeElement& element, const NodeType& type,
                                const Reporter& report);

}  // namespace lockstep::host
