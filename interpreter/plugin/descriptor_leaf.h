// One leaf of a plugin's descriptor, checked and translated. Only for descriptor.cpp.
#pragma once

#include <optional>

#include "plugin/descriptor.h"

namespace lockstep {

// The message says what is wrong with "it". Leaves `node_type` alone.
std::optional<Problem> read_leaf(const lockstep_leaf_type* from, Descriptors::Leaf& leaf);

}  // namespace lockstep
