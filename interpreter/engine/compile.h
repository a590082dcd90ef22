// Definition -> Tree: the last step before a run. It cannot fail.
#pragma once

#include "engine/tree.h"
#include "tree/definition.h"

namespace lockstep::host {

// The tree points to the node types of the definition's catalog; it does not need the definition.
Tree compile(const Definition& definition);

}  // namespace lockstep::host
