#include "loading/plugins.h"

#include <filesystem>

#include "core/clock.h"
#include "definition/plugin_requests.h"
#include "engine/node_kind.h"
#include "loading/plugin_directories.h"

namespace lockstep {
namespace {

// Where lockstep-leafhost is: beside this program in a build directory, else where it is installed.
std::string leafhost_path(const PluginOptions& options) {
  const auto directory = program_directory(options);
  const auto beside = directory / "lockstep-leafhost";
  std::error_code error;
  if (std::filesystem::exists(beside, error)) return beside.string();
  return (directory / LOCKSTEP_LEAFHOST_FROM_BIN).lexically_normal().string();
}

}  // namespace

bool is_plugin_file(const std::string& plugin) {
  return plugin.find('/') != std::string::npos || plugin.ends_with(".so");
}

bool load_given_plugins(const PluginOptions& options, PluginSet& plugins,
                        Diagnostics& diagnostics) {
  plugins.set_isolation({.leafhost = leafhost_path(options),
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

bool load_requested_plugins(const PluginOptions& options, const Project& project,
                            PluginSet& plugins, Diagnostics& diagnostics) {
  bool good = true;
  const auto directories = plugin_directories(options);
  for (const PluginRequest& request : requested_plugins(project, diagnostics)) {
    const auto isolation = request.isolate ? Isolation::Isolated : Isolation::InProcess;
    Diagnostics refused;
    good &= plugins.load_named(request.name, directories, refused, {}, isolation);
    for (Diagnostic diagnostic : refused.all()) {  // only these need a location
      diagnostic.location = project.sources.locate_value(request.place);
      diagnostics.add(std::move(diagnostic));
    }
  }
  return good;
}

Catalog make_catalog(const PluginSet& plugins, Language language) {
  Catalog catalog;
  for (const NodeKind* kind : built_in_kinds(language)) catalog.add(&kind->type);
  for (const NodeType* type : plugins.types()) catalog.add(type);
  return catalog;
}

}  // namespace lockstep
