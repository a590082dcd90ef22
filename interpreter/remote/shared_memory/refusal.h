// Which leaves can be isolated.
#pragma once

#include <optional>

#include "core/problem.h"
#include "plugin/contract/descriptor.h"

namespace lockstep {

// Why a leaf cannot run in a separate process. The message says what is wrong with its plugin.
std::optional<Problem> refuse_isolation(const Descriptors::Leaf& leaf);

}  // namespace lockstep
