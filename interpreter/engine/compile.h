// Definition -> Tree: the last step before a run. It cannot fail.
#pragma once

#include "definition/definition.h"
#include "engine/tree.h"

namespace lockstep::host {

// The tree points to the node types of the definition's catalog; it does not need the definition.
Tree compile(const Definition& definition);

}  // namespace lockstep::host
