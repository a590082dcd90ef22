#include "cli/load/load_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/checks.h"
#include "cli/exit_code.h"
#include "core/clock.h"
#include "core/freed_memory.h"
#include "runtime/plugin_thread.h"

namespace lockstep {
namespace {

// "name=value" pairs; a later one replaces an earlier one.
Arguments parse_pairs(const std::vector<std::string>& pairs, std::string_view option,
                      Diagnostics& diagnostics) {
  Arguments map;
  for (const std::string& pair : pairs) {
    const auto equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      diagnostics.error({}, fmt::format("{} {}: expected name=value", option, pair));
    } else {
      map[pair.substr(0, equals)] = pair.substr(equals + 1);
    }
  }
  return map;
}

}  // namespace

void add_plugin_options(CLI::App& app, PluginOptions& options) {
  app.add_option("--plugin", options.plugins,
                 "Load this plugin: a file (.so), or a name to search for; may be repeated")
      ->type_name("FILE|NAME")
      ->allow_extra_args(false);
  app.add_option("--plugin-path", options.directories,
                 "Search plugins in this directory first; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  app.add_flag("--isolate", options.isolate,
               "Run every plugin in a separate process, so that a crash or a hang does no harm; "
               "for one plugin: <plugin name=\"…\" isolate=\"true\"/>");
  app.add_option("--hang-limit", options.hang_limit,
                 "A call into a plugin that takes longer than S seconds is a hang: it ends the "
                 "program or, for an isolated plugin, its process; 0 = never")
      ->type_name("S")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
}

void add_load_options(CLI::App& app, LoadCommandOptions& options) {
  app.add_option("--tree", options.main_tree,
                 "The BehaviorTree to run (default: main_tree_to_execute)")
      ->type_name("ID");
  app.add_option("--arg", options.arguments,
                 "The value of an <arg> of the tree, used as ${NAME}; may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  app.add_option("--set", options.values,
                 "The start value of a blackboard entry {KEY}; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_plugin_options(app, options.plugins);
}

tl::expected<Loaded, LoadFailure> load_given(const std::string& path,
                                             const LoadCommandOptions& options,
                                             Diagnostics& diagnostics,
                                             std::shared_ptr<PluginSet> plugins) {
  keep_freed_memory();
  watch_this_thread(from_seconds(options.plugins.hang_limit));
  return load(path,
              {.plugins = options.plugins,
               .arguments = parse_pairs(options.arguments, "--arg", diagnostics),
               .values = parse_pairs(options.values, "--set", diagnostics),
               .main_tree = options.main_tree,
               .main_file = options.main_file},
              diagnostics, std::move(plugins));
}

int exit_code_of(LoadFailure failure) {
  if (failure == LoadFailure::Options) return kExitUsage;
  return failure == LoadFailure::PluginRefused ? kExitPluginRefused : kExitInvalidTree;
}

}  // namespace lockstep
