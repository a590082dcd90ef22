// The nodes of a command without a tree: the built-in nodes and the plugins that the command line
// names. For `lockstep nodes` and `lockstep schema`.
#pragma once

#include "run/loading/plugins.h"

namespace lockstep::host {

// Prints errors. Returns the exit code. The catalog lives as long as `plugins`.
int load_catalog(const PluginOptions& options, PluginSet& plugins, Catalog& catalog);

}  // namespace lockstep::host
