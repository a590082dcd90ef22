// What the nodes of other tools are called here: a Selector of Unreal or py_trees is a Fallback.
#pragma once

#include <string>
#include <string_view>

#include "tree/catalog.h"

namespace lockstep::host {

// The hint for an unknown node: "write <Fallback>"; "" for a word that no tool has. `catalog` has
// the nodes of the tree's language.
std::string hint_for_other_tools(std::string_view tag, const Catalog& catalog);

}  // namespace lockstep::host
