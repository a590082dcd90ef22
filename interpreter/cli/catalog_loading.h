// Which nodes a command speaks of when no tree says it: the built-ins and the plugins that the
// command line names. For `lockstep nodes` and `lockstep schema`.
#pragma once

#include <string_view>

#include "cli/loading.h"

namespace lockstep {

// Prints what is wrong. Returns the exit code. The catalog lives as long as `plugins`.
int load_catalog(const PluginOptions& options, PluginSet& plugins, Catalog& catalog);

// Writes `text` to stdout; what is wrong with that goes to stderr. Returns the exit code.
int write_stdout(std::string_view text);

}  // namespace lockstep
