// Which plugins can be isolated.
#pragma once

#include <optional>

#include "core/problem.h"
#include "plugin/descriptor.h"

namespace lockstep {

// Why a plugin cannot run in a separate process. The message says what is wrong with "it".
std::optional<Problem> refuse_isolation(const Descriptors& descriptors);

}  // namespace lockstep
