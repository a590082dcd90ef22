// The statements of a plugin about what the leaves of a type do, checked.
#pragma once

#include <optional>
#include <span>

#include "base/core/node_type.h"
#include "base/core/problem.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// `leaf` has the full size that this host knows.
std::optional<Problem> check_behavior(const lockstep_leaf_type& leaf,
                                      std::span<const Parameter> ports);

}  // namespace lockstep::host
