// Why a tree that can no longer end cannot: the conditions that are false in all that it can still
// do, and the entries that they read.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verify/trace.h"

namespace lockstep::host {

// `reached`: of each state, whether it can still be reached; all of these were looked at. `at`
// names a node with its place. A line for each condition; none where that are too many ticks.
std::vector<std::string> false_for_ever(const Tree& tree, const LeafModels& models, Tracer& tracer,
                                        const std::vector<bool>& reached,
                                        const std::function<std::string(NodeIndex)>& at,
                                        const std::optional<Nanoseconds>& until);

}  // namespace lockstep::host
