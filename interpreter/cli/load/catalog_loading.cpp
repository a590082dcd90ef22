#include "cli/load/catalog_loading.h"

#include "base/core/clock.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "run/plugin_thread.h"

namespace lockstep::host {

int load_catalog(const PluginOptions& options, PluginSet& plugins, Catalog& catalog) {
  keep_stdout_for_results();
  watch_this_thread(from_seconds(options.hang_limit));
  Diagnostics diagnostics;
  const bool good = load_given_plugins(options, plugins, diagnostics);
  print_diagnostics(diagnostics, Severity::Warning);
  if (!good) return kExitPluginRefused;
  note_project_plugins(plugins, options);
  catalog = make_catalog(plugins);
  return kExitSuccess;
}

}  // namespace lockstep::host
