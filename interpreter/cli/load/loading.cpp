#include "cli/load/loading.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "cli/checks.h"
#include "cli/exit_code.h"
#include "cli/load/plugin_directories.h"
#include "core/freed_memory.h"
#include "definition/plugin_requests.h"
#include "engine/compile.h"
#include "engine/node_kind.h"
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

// What is wrong with the command line has no place in a file.
int exit_code_of(const Diagnostics& diagnostics) {
  const bool in_file = std::ranges::any_of(diagnostics.all(), [](const Diagnostic& it) {
    return it.severity == Severity::Error && !it.location.file.empty();
  });
  if (in_file) return kExitInvalidTree;
  return diagnostics.has_errors() ? kExitUsage : kExitSuccess;
}

// Loads what the trees ask for. Places are looked up only for what was refused.
bool load_requested_plugins(const PluginOptions& options, const Project& project,
                            PluginSet& plugins, Diagnostics& diagnostics) {
  bool good = true;
  const auto directories = plugin_directories(options);
  for (const PluginRequest& request : requested_plugins(project, diagnostics)) {
    const auto isolation = request.isolate ? Isolation::Isolated : Isolation::InProcess;
    Diagnostics refused;
    good &= plugins.load_named(request.name, directories, refused, {}, isolation);
    for (Diagnostic diagnostic : refused.all()) {
      diagnostic.location = project.sources.locate_value(request.place);
      diagnostics.add(std::move(diagnostic));
    }
  }
  return good;
}

// Where lockstep-leafhost is: beside this program in a build directory, else where it is installed.
std::string leafhost_path() {
  const auto directory = program_directory();
  const auto beside = directory / "lockstep-leafhost";
  std::error_code error;
  if (std::filesystem::exists(beside, error)) return beside.string();
  return (directory / LOCKSTEP_LEAFHOST_FROM_BIN).lexically_normal().string();
}

}  // namespace

void add_plugin_options(CLI::App& app, PluginOptions& options) {
  app.add_option("--plugin", options.plugins,
                 "Load this plugin: a file (.so), or a name that is searched for; may be repeated")
      ->type_name("FILE|NAME")
      ->allow_extra_args(false);
  app.add_option("--plugin-path", options.directories,
                 "Search plugins in this directory first; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  app.add_flag("--isolate", options.isolate,
               "Keep every plugin in a process of its own, which may crash or hang without harm; "
               "for one plugin: <plugin name=\"…\" isolate=\"true\"/>");
  app.add_option("--hang-limit", options.hang_limit,
                 "A call into a plugin that lasts longer than S seconds is a hang: it ends the "
                 "program, or, isolated, the plugin's process; 0 = never")
      ->type_name("S")
      ->check(number_between(0.0, 1e6))
      ->capture_default_str();
}

void add_load_options(CLI::App& app, LoadOptions& options) {
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

bool is_plugin_file(const std::string& plugin) {
  return plugin.find('/') != std::string::npos || plugin.ends_with(".so");
}

bool load_given_plugins(const PluginOptions& options, PluginSet& plugins,
                        Diagnostics& diagnostics) {
  watch_this_thread(from_seconds(options.hang_limit));
  plugins.set_isolation({.leafhost = leafhost_path(),
                         .hang_limit = from_seconds(options.hang_limit),
                         .all = options.isolate});
  if (!check_plugin_options(options, diagnostics)) return false;
  bool good = true;
  const auto directories = plugin_directories(options);
  for (const std::string& plugin : options.plugins) {
    good &= is_plugin_file(plugin) ? plugins.load_file(plugin, diagnostics)
                                   : plugins.load_named(plugin, directories, diagnostics);
  }
  return good;
}

Catalog make_catalog(const PluginSet& plugins) {
  Catalog catalog;
  for (const NodeKind* kind : built_in_kinds()) catalog.add(&kind->type);
  for (const NodeType* type : plugins.types()) catalog.add(type);
  return catalog;
}

int load(const std::string& path, const LoadOptions& options, Loaded& loaded,
         Diagnostics& diagnostics) {
  keep_freed_memory();
  const Arguments arguments = parse_pairs(options.arguments, "--arg", diagnostics);
  ResolveOptions resolve_options{options.main_tree,
                                 parse_pairs(options.values, "--set", diagnostics)};
  loaded.project = load_project(path, arguments, diagnostics, options.main_file);
  if (loaded.plugins == nullptr) loaded.plugins = std::make_shared<PluginSet>();
  Diagnostics refused;
  bool good = load_given_plugins(options.plugins, *loaded.plugins, refused);
  if (loaded.project != nullptr) {
    good &= load_requested_plugins(options.plugins, *loaded.project, *loaded.plugins, refused);
  }
  const int code_so_far = exit_code_of(diagnostics);
  for (const Diagnostic& diagnostic : refused.all()) diagnostics.add(diagnostic);
  // Without its leaves, most of the tree would be called unknown.
  if (!good) return code_so_far == kExitSuccess ? kExitPluginRefused : code_so_far;
  if (loaded.project != nullptr) {
    loaded.catalog = make_catalog(*loaded.plugins);
    loaded.definition = resolve(*loaded.project, loaded.catalog, resolve_options, diagnostics);
  }
  if (diagnostics.has_errors()) loaded.definition.reset();
  return exit_code_of(diagnostics);
}

Tree take_tree(Loaded& loaded) {
  Tree tree = compile(*loaded.definition);
  loaded.definition.reset();
  loaded.project->documents.clear();
  loaded.project->sources = {};
  return_freed_memory();
  return tree;
}

}  // namespace lockstep
