// Calls the init of a plugin. Only within plugin/.
#pragma once

#include <string>

#include "lockstep/leaf.h"

namespace lockstep {

// "" or why it did not work: "refuses to work: …". A plugin without init works.
std::string initialize_plugin(const lockstep_plugin& plugin);

}  // namespace lockstep
