// Calls the init of a plugin. Only within plugin/.
#pragma once

#include <string>

#include "lockstep/leaf.h"

namespace lockstep {

// Returns "" or the reason of a failure: "refuses to work: …". A plugin without init succeeds.
std::string initialize_plugin(const lockstep_plugin& plugin);

}  // namespace lockstep
