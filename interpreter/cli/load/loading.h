// From a file name to a tree that can run: the arrows of docs/architecture.md, one after the other.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "definition/catalog.h"
#include "definition/resolve.h"
#include "document/project.h"
#include "engine/tree.h"
#include "plugin/plugin_set.h"

namespace CLI {
class App;
}

namespace lockstep {

struct PluginOptions {
  std::vector<std::string> plugins;      // --plugin: a path, or a name to search for
  std::vector<std::string> directories;  // --plugin-path
  bool isolate = false;                  // --isolate
  double hang_limit = 10;                // --hang-limit, in seconds; 0 = never
};

struct LoadOptions {
  PluginOptions plugins;
  std::vector<std::string> arguments;  // --arg name=value
  std::vector<std::string> values;     // --set key=value
  std::string main_tree;               // --tree
  MainFile main_file = MainFile::MayBePipe;
};

// --plugin, --plugin-path, --isolate and --hang-limit.
void add_plugin_options(CLI::App& app, PluginOptions& options);
// The plugin options, --arg, --set and --tree.
void add_load_options(CLI::App& app, LoadOptions& options);

// Whether a --plugin is a file, and not a name to search for.
bool is_plugin_file(const std::string& plugin);

// Loads what --plugin names. On false, errors tell why. From here on this thread is watched.
bool load_given_plugins(const PluginOptions& options, PluginSet& plugins, Diagnostics& diagnostics);

// The built-in nodes and the leaves of `plugins`.
Catalog make_catalog(const PluginSet& plugins);

struct Loaded {
  std::unique_ptr<Project> project;
  std::shared_ptr<PluginSet> plugins;  // may be given: several trees that share their plugins
  Catalog catalog;
  std::optional<Definition> definition;
};

// Does all that can be done; `definition` is there when nothing was wrong. Returns the exit code.
int load(const std::string& path, const LoadOptions& options, Loaded& loaded,
         Diagnostics& diagnostics);

// Compiles the definition, which is there, and forgets it and the documents: a run needs neither.
Tree take_tree(Loaded& loaded);

}  // namespace lockstep
