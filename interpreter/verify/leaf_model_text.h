// A leaf model to fill in, for the leaves of a tree: what it states is true of every leaf that
// keeps its contract, so it changes no verdict until somebody edits it.
#pragma once

#include <string>
#include <vector>

#include "engine/tree.h"

namespace lockstep::host {

// `tree_file` is for the comment at the top; `observed` has the entries, by slot, that something
// besides the tree reads.
std::string leaf_model_text(const Tree& tree, const std::string& tree_file,
                            const std::vector<std::uint32_t>& observed = {});

}  // namespace lockstep::host
