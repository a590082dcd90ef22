#include "cli/catalog_options.h"

#include <CLI/CLI.hpp>

#include "cli/console.h"
#include "cli/exit_code.h"

namespace lockstep {

void add_catalog_options(CLI::App& app, CatalogOptions& options) {
  app.add_option("--with", options.names,
                 "Load the plugin of this name, searched for as a tree's <plugin name> is; may be "
                 "repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  add_plugin_options(app, options.plugins);
}

int load_catalog(const CatalogOptions& options, PluginSet& plugins, Catalog& catalog) {
  Diagnostics diagnostics;
  bool good = true;
  for (const std::string& file : options.plugins.files) {
    good &= plugins.load_file(file, diagnostics);
  }
  const auto directories = plugin_directories(options.plugins);
  for (const std::string& name : options.names) {
    good &= plugins.load_named(name, directories, diagnostics);
  }
  print_diagnostics(diagnostics, Severity::Warning, stderr);
  if (!good) return kExitPluginRefused;
  catalog = make_catalog(plugins);
  return kExitSuccess;
}

int write_stdout(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  return flush_stdout() ? kExitSuccess : kExitUsage;
}

}  // namespace lockstep
