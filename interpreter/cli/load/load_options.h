// The command line options for loading a tree, and loading with them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/loading/load.h"

namespace CLI {
class App;
}

namespace lockstep::host {

struct LoadCommandOptions {
  PluginOptions plugins;
  std::vector<std::string> arguments;  // --arg name=value
  std::vector<std::string> values;     // --set key=value
  StartValues later = {};              // of entries that get one while the tree runs
  std::string main_tree;               // --tree
  MainFile main_file = MainFile::MayBePipe;
  std::optional<std::string> text = {};   // in place of what the main file has
  std::vector<std::string> ros_packages;  // --ros-package name=directory
  MissingNodes unknown = MissingNodes::AreErrors;
  bool may_lack_main = false;
  bool is_part = false;                         // of a file that includes it
  TreeIds elsewhere = {};                       // trees of files that it does not include
  std::shared_ptr<const Library> library = {};  // besides that of the project file
  bool mock = false;                            // --mock
  std::vector<std::string> mock_leaves;         // --mock-leaf id=result
  std::vector<std::string> mock_outputs;        // --mock-output port=value
};

// --run-programs, for commands that run no tree.
void add_program_option(CLI::App& app, PluginOptions& options);
// --plugin, --plugin-path, --isolate and --hang-limit.
void add_plugin_options(CLI::App& app, PluginOptions& options);
// Notes which plugins come from the build of the user's project.
void note_project_plugins(const PluginSet& plugins, const PluginOptions& options);
// The plugin options, --arg, --set, --tree and --ros-package.
void add_load_options(CLI::App& app, LoadCommandOptions& options);

// --mock and --mock-output: for a command that does not run the tree.
void add_mock_option(CLI::App& app, LoadCommandOptions& options);
// --mock, --mock-leaf and --mock-output.
void add_mock_options(CLI::App& app, LoadCommandOptions& options);

// Calls load() with them. From now on this thread is watched.
[[nodiscard]] tl::expected<Loaded, LoadFailure> load_given(
    const std::string& path, const LoadCommandOptions& options, Diagnostics& diagnostics,
    std::shared_ptr<PluginSet> plugins = std::make_shared<PluginSet>());

// The same with load_trees(). `diagnostics` must outlive what is returned.
[[nodiscard]] tl::expected<LoadedTrees, LoadFailure> load_trees_given(
    const std::string& path, const LoadCommandOptions& options, Diagnostics& diagnostics,
    std::shared_ptr<PluginSet> plugins);

int exit_code_of(LoadFailure failure);

}  // namespace lockstep::host
