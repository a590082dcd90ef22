// Finds and loads the plugins that the options or a tree name, and makes the catalog of nodes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "language/document/project.h"
#include "run/loading/plugin_set.h"
#include "tree/catalog.h"

namespace lockstep::host {

// Messages call them by the options of the command line.
struct PluginOptions {
  std::vector<std::string> plugins;      // --plugin: a path, or a name to search for
  std::vector<std::string> directories;  // --plugin-path
  bool isolate = false;                  // --isolate
  double hang_limit = 10;                // --hang-limit, in seconds; 0 = never
  double halt_limit = 1;                 // --halt-limit, in seconds; 0 = never
  // --condition-wait, --condition-age, in seconds; nothing: of the period
  std::optional<double> condition_wait = {}, condition_age = {};
  // --run-programs: else a program is not started, and its leaves are read from a file beside it.
  bool run_programs = false;
  // For programs that run no leaves: no code of a plugin enters this process.
  bool only_described = false;
  // Searched after all others: that of the user's project. The command line sets it.
  std::string project_build = {};
  // From where what is installed with lockstep is found; "": that of the running program.
  std::string program_directory;
};

// The module that reaches the robots of a team: team/network.h.
std::string team_module(const PluginOptions& options);

IsolationOptions isolation_options(const PluginOptions& options);

// Whether a plugin is given as a file, and not as a name to search for.
bool is_plugin_file(const std::string& plugin);

// Loads what `options` names. Returns false, with errors, on failure.
[[nodiscard]] bool load_given_plugins(const PluginOptions& options, PluginSet& plugins,
                                      Diagnostics& diagnostics);
// A plugin that is not found is an error, or with AreTold a warning.
enum class MissingPlugins : bool { AreErrors, AreTold };
// The same for what the trees of `project` ask for.
[[nodiscard]] bool load_requested_plugins(const PluginOptions& options, const Project& project,
                                          PluginSet& plugins, Diagnostics& diagnostics,
                                          MissingPlugins missing = MissingPlugins::AreErrors);

// The built-in nodes of a language and the leaves of `plugins` whose ID is none of theirs. It lives
// as long as these.
Catalog make_catalog(const PluginSet& plugins, const LanguageRules& rules = kLockstepRules);
// Says which leaves are not in it.
void warn_of_shadowed(const PluginSet& plugins, const LanguageRules& rules,
                      Diagnostics& diagnostics);

}  // namespace lockstep::host
