// Calls init and deinit of plugins: once per process, although several sets may have the same
// plugin. Only within plugin/. Any thread.
#pragma once

#include <string>

#include "lockstep/leaf.h"

namespace lockstep::host {

// Calls init, unless another user of the plugin has done so. Returns "" or the reason of a failure:
// "refuses to work: …". A plugin without init succeeds.
std::string initialize_plugin(const lockstep_plugin& plugin);

// For each success of initialize_plugin. The last one calls deinit.
void deinitialize_plugin(const lockstep_plugin& plugin);

}  // namespace lockstep::host
