#include "cli/catalog_loading.h"

#include "cli/console.h"
#include "cli/exit_code.h"

namespace lockstep {

int load_catalog(const PluginOptions& options, PluginSet& plugins, Catalog& catalog) {
  Diagnostics diagnostics;
  const bool good = load_given_plugins(options, plugins, diagnostics);
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
