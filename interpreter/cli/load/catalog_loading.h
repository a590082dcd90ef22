// Which nodes a command speaks of when no tree says it: the built-ins and the plugins that the
// command line names. For `lockstep nodes` and `lockstep schema`.
#pragma once

#include "loading/plugins.h"

namespace lockstep {

// Prints what is wrong. Returns the exit code. The catalog lives as long as `plugins`.
int load_catalog(const PluginOptions& options, PluginSet& plugins, Catalog& catalog);

}  // namespace lockstep
