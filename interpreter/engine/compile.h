// Definition -> Tree: the last arrow before a run. Nothing can go wrong here any more.
#pragma once

#include "definition/definition.h"
#include "engine/tree.h"

namespace lockstep {

// The tree points to the node types of the definition's catalog; it does not need the definition.
Tree compile(const Definition& definition);

}  // namespace lockstep
