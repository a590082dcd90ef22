#include "run/loading/plugins.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/core/clock.h"
#include "base/core/wording.h"
#include "engine/node_kind.h"
#include "leaves/plugin/contract/descriptor.h"
#include "leaves/plugin/open/plugin_path.h"
#include "run/loading/plugin_directories.h"
#include "tree/check/plugin_requests.h"

namespace lockstep::host {
namespace {

// Where lockstep-leafhost is: beside this program in a build directory, else where it is installed.
// Beside the program, or where it is installed with it.
std::string installed_file(const PluginOptions& options, const char* name) {
  const auto directory = program_directory(options);
  std::error_code error;
  if (std::filesystem::exists(directory / name, error)) return (directory / name).string();
  const auto leafhost = directory / LOCKSTEP_LEAFHOST_FROM_BIN;
  return leafhost.lexically_normal().replace_filename(name).string();
}

Hold hold_of(std::string_view word) {
  if (word.empty()) return Hold::AsItSays;
  if (word == "signal") return Hold::Signal;
  return word == "message" ? Hold::Message : Hold::None;
}

// By its name, also a program: nothing else could say so.
bool load_searched(const std::string& name, const std::vector<std::string>& directories,
                   PluginSet& plugins, Diagnostics& diagnostics) {
  if (!find_plugin_file(name, directories)) {
    if (const std::string file = program_named(name, directories); !file.empty()) {
      const std::string plugin = std::filesystem::path(file).stem().string();
      return plugins.load_program({plugin, file}, directories, diagnostics);
    }
  }
  return plugins.load_named(name, directories, diagnostics);
}

// False: it is not loaded, and nowhere to be found.
bool is_there(const PluginRequest& request, const std::vector<std::string>& directories,
              const PluginSet& plugins) {
  const auto loaded = plugins.list();
  if (std::ranges::find(loaded, request.name, &PluginSet::Info::name) != loaded.end()) return true;
  if (!request.program.empty()) return bool(find_program_file(request.program, directories));
  return !is_plugin_name(request.name) || find_plugin_file(request.name, directories);
}

std::optional<Nanoseconds> limit_of(const std::optional<double>& seconds) {
  return seconds ? std::optional(from_seconds(*seconds)) : std::nullopt;
}

}  // namespace

bool is_plugin_file(const std::string& plugin) {
  return plugin.find('/') != std::string::npos || plugin.ends_with(".so");
}

std::string team_module(const PluginOptions& options) {
  return installed_file(options, "lockstep-team.so");
}

IsolationOptions isolation_options(const PluginOptions& options) {
  const bool is_limited = options.halt_limit > 0;
  return {.leafhost = installed_file(options, "lockstep-leafhost"),
          .hang_limit = from_seconds(options.hang_limit),
          .halt_limit = is_limited ? std::optional(from_seconds(options.halt_limit)) : std::nullopt,
          .condition_wait = limit_of(options.condition_wait),
          .condition_age = limit_of(options.condition_age),
          .all = options.isolate,
          .run_programs = options.run_programs,
          .only_described = options.only_described};
}

bool load_given_plugins(const PluginOptions& options, PluginSet& plugins,
                        Diagnostics& diagnostics) {
  plugins.set_isolation(isolation_options(options));
  if (!check_plugin_options(options, diagnostics)) return false;
  bool good = true;
  const auto directories = plugin_directories(options);
  for (const std::string& plugin : options.plugins) {
    good &= is_plugin_file(plugin) ? plugins.load_file(plugin, diagnostics)
                                   : load_searched(plugin, directories, plugins, diagnostics);
  }
  return good;
}

bool load_requested_plugins(const PluginOptions& options, const Project& project,
                            PluginSet& plugins, Diagnostics& diagnostics, MissingPlugins missing) {
  bool good = true;
  const auto directories = plugin_directories(options);
  for (const PluginRequest& request : requested_plugins(project, diagnostics)) {
    if (missing == MissingPlugins::AreTold && !is_there(request, directories, plugins)) {
      diagnostics.warning("mocked-node"_code, project.sources.locate_value(request.place),
                          fmt::format("plugin '{}' is not found", brief(request.name)),
                          "its nodes are mocked");
      continue;
    }
    const auto isolation = request.isolate ? Isolation::Isolated : Isolation::InProcess;
    Diagnostics refused;
    good &= request.program.empty()
                ? plugins.load_named(request.name, directories, refused, {}, isolation)
                : plugins.load_program({request.name, request.program, hold_of(request.hold)},
                                       directories, refused);
    for (Diagnostic diagnostic : refused.all()) {  // only these need a location
      diagnostic.location = project.sources.locate_value(request.place);
      diagnostics.add(std::move(diagnostic));
    }
  }
  return good;
}

// Plugins had leaves with this name before the language had the node.
static bool gives_way(const NodeType& type) {
  return type.asks && type.plugin.empty();
}

Catalog make_catalog(const PluginSet& plugins, const LanguageRules& rules) {
  Catalog catalog;
  for (const NodeKind* kind : built_in_kinds(rules)) catalog.add(&kind->type);
  for (const NodeType* type : plugins.types()) {
    const NodeType* const known = catalog.find(type->id);
    if (known == nullptr) {
      catalog.add(type);
    } else if (gives_way(*known)) {
      catalog.replace(type);
    }
  }
  catalog.set_words(plugins.words());
  return catalog;
}

void warn_of_shadowed(const PluginSet& plugins, const LanguageRules& rules,
                      Diagnostics& diagnostics) {
  for (const NodeType* type : plugins.types()) {
    const bool is_shadowed = std::ranges::any_of(built_in_kinds(rules), [&](const NodeKind* kind) {
      return kind->type.id == type->id && !gives_way(kind->type);
    });
    if (!is_shadowed) continue;
    diagnostics.warning(
        "hidden-leaf"_code, {},
        fmt::format("the leaf '{}' of plugin '{}' cannot be used here", type->id, type->plugin),
        "the language of the tree has a node of that name; give the leaf another ID");
  }
}

}  // namespace lockstep::host
