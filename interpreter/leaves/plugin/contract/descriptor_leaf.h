// One leaf of a plugin's descriptor, checked and translated. Only for descriptor.cpp.
#pragma once

#include <optional>

#include "leaves/plugin/contract/descriptor.h"

namespace lockstep::host {

// `plugin` is the name of its plugin. The message says what is wrong with "it". Leaves `node_type`
// alone.
std::optional<Problem> read_leaf(const lockstep_leaf_type* from, std::string_view plugin,
                                 Descriptors::Leaf& leaf);

}  // namespace lockstep::host
