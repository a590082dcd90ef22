// A plan as a whole document, as a user would write it: subtrees are trees of their own.
#pragma once

#include <string>

#include "property/plan.h"

namespace lockstep::host::test {

// As tree_from_document reads it.
std::string document_text(const Plan& plan);

}  // namespace lockstep::host::test
