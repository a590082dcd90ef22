// The command line options for loading a tree, and loading with them.
#pragma once

#include <string>
#include <vector>

#include "loading/load.h"

namespace CLI {
class App;
}

namespace lockstep {

struct LoadCommandOptions {
  PluginOptions plugins;
  std::vector<std::string> arguments;  // --arg name=value
  std::vector<std::string> values;     // --set key=value
  std::string main_tree;               // --tree
  MainFile main_file = MainFile::MayBePipe;
};

// --plugin, --plugin-path, --isolate and --hang-limit.
void add_plugin_options(CLI::App& app, PluginOptions& options);
// The plugin options, --arg, --set and --tree.
void add_load_options(CLI::App& app, LoadCommandOptions& options);

// Calls load() with them. From now on this thread is watched.
[[nodiscard]] tl::expected<Loaded, LoadFailure> load_given(
    const std::string& path, const LoadCommandOptions& options, Diagnostics& diagnostics,
    std::shared_ptr<PluginSet> plugins = std::make_shared<PluginSet>());

int exit_code_of(LoadFailure failure);

}  // namespace lockstep
