#include "cli/loading.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "cli/exit_code.h"
#include "engine/node_kind.h"

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

bool load_plugins(const PluginOptions& options, const Project* project, PluginSet& plugins,
                  Diagnostics& diagnostics) {
  bool good = load_given_plugins(options, plugins, diagnostics);
  if (project == nullptr) return good;
  const auto directories = plugin_directories(options);
  for (const PluginRequest& request : requested_plugins(*project, diagnostics)) {
    good &= plugins.load_named(request.name, directories, diagnostics, request.where);
  }
  return good;
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

std::vector<std::string> plugin_directories(const PluginOptions& options) {
  std::vector<std::string> directories = options.directories;
  if (const char* path = std::getenv("LOCKSTEP_PLUGIN_PATH")) {
    for (const std::string& directory : CLI::detail::split(path, ':')) {
      if (!directory.empty()) directories.push_back(directory);
    }
  }
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) {
    const auto beside = program.parent_path();
    directories.push_back((beside / "plugins").string());  // in a build directory
    directories.push_back((beside / LOCKSTEP_PLUGINS_FROM_BIN).lexically_normal().string());
  }
  return directories;
}

bool load_given_plugins(const PluginOptions& options, PluginSet& plugins,
                        Diagnostics& diagnostics) {
  bool good = true;
  const auto directories = plugin_directories(options);
  for (const std::string& plugin : options.plugins) {
    const bool is_file = plugin.find('/') != std::string::npos || plugin.ends_with(".so");
    good &= is_file ? plugins.load_file(plugin, diagnostics)
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
  const Arguments arguments = parse_pairs(options.arguments, "--arg", diagnostics);
  ResolveOptions resolve_options{options.main_tree,
                                 parse_pairs(options.values, "--set", diagnostics)};
  loaded.project = load_project(path, arguments, diagnostics);
  if (loaded.plugins == nullptr) loaded.plugins = std::make_shared<PluginSet>();
  Diagnostics refused;
  if (!load_plugins(options.plugins, loaded.project.get(), *loaded.plugins, refused)) {
    const int code = diagnostics.has_errors() ? exit_code_of(diagnostics) : kExitPluginRefused;
    for (const Diagnostic& diagnostic : refused.all()) diagnostics.add(diagnostic);
    return code;  // without its leaves, most of the tree would be called unknown
  }
  for (const Diagnostic& diagnostic : refused.all()) diagnostics.add(diagnostic);
  if (loaded.project != nullptr) {
    loaded.catalog = make_catalog(*loaded.plugins);
    loaded.definition = resolve(*loaded.project, loaded.catalog, resolve_options, diagnostics);
  }
  if (diagnostics.has_errors()) loaded.definition.reset();
  return exit_code_of(diagnostics);
}

}  // namespace lockstep
