// Which nodes a command speaks of when no tree says it: the built-ins and the plugins that the
// command line names. For `lockstep nodes` and `lockstep schema`.
#pragma once

#include <string>
#include <vector>

#include "cli/loading.h"

namespace lockstep {

struct CatalogOptions {
  PluginOptions plugins;
  std::vector<std::string> names;  // --with: searched for, as <plugin name> is
};

void add_catalog_options(CLI::App& app, CatalogOptions& options);

// Prints what is wrong. Returns the exit code. The catalog lives as long as `plugins`.
int load_catalog(const CatalogOptions& options, PluginSet& plugins, Catalog& catalog);

// Writes `text` to stdout; what is wrong with that goes to stderr. Returns the exit code.
int write_stdout(std::string_view text);

}  // namespace lockstep
