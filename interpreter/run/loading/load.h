// From a file name to a tree that can run: the steps of docs/architecture.md in order. For the
// commands and for programs that embed lockstep: nothing here prints, knows exit codes or changes
// the process.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "base/core/diagnostics.h"
#include "engine/tree.h"
#include "language/document/library.h"
#include "language/document/project.h"
#include "language/property/property.h"
#include "run/loading/plugins.h"
#include "tree/check/stand_ins.h"
#include "tree/expand/expand.h"
#include "tree/resolve.h"

namespace lockstep::host {

struct LoadOptions {
  PluginOptions plugins;
  Arguments arguments;     // of <arg>
  StartValues values;      // of blackboard entries
  StartValues later = {};  // of entries that get one while the tree runs: it has their types
  std::string main_tree;   // "": the one that the file names, or its only one
  MainFile main_file = MainFile::MayBePipe;
  Arguments ros_packages = {};  // the share directories of ROS packages, by name
  MissingNodes unknown = MissingNodes::AreErrors;
  Mocks mocks = {};
  MockOutputs mock_outputs = {};
  bool opens_entries = false;  // the program uses entries by their names
  bool has_outside = false;    // "@key" is none of the main tree, but of a board of the program
  UnsavedTexts unsaved = {};   // read instead of the files that a tree includes
  bool may_lack_main = false;  // LoadFailure::NothingToRun instead of an error
  bool is_part = false;        // of a file that includes it
  TreeIds elsewhere = {};      // trees of files that this one does not include
  std::shared_ptr<const Library> library = {};  // where SubTrees find those of other files
  bool is_advised = true;  // false: who asks needs no warnings about a tree that has no error
};

// A definition without errors, and the objects that it refers to.
struct Loaded {
  std::shared_ptr<PluginSet> plugins;
  std::unique_ptr<Project> project;
  Definition definition;
  std::vector<Property> properties = {};  // of the main file
  StartValues values = {};                // that the options gave
};

// Why loading failed; the errors have the details.
enum class LoadFailure : unsigned char {
  Options,        // the file is not to blame: an option names what it does not have
  Unreadable,     // the main file is not there, or not XML
  Invalid,        // a file breaks a rule of the language
  PluginRefused,  // a plugin cannot be loaded
  NothingToRun,   // no error, but trees for other files, or none
};

// Reports all errors, warnings and notes. Fails also if `diagnostics` already has errors. Several
// trees may share `plugins`, which keep what was loaded, even after a failure.
[[nodiscard]] tl::expected<Loaded, LoadFailure> load(
    const std::string& path, const LoadOptions& options, Diagnostics& diagnostics,
    std::shared_ptr<PluginSet> plugins = std::make_shared<PluginSet>());
// The same from `text` instead of a main file; includes are relative to `path`.
[[nodiscard]] tl::expected<Loaded, LoadFailure> load_text(
    const std::string& path, std::string text, const LoadOptions& options, Diagnostics& diagnostics,
    std::shared_ptr<PluginSet> plugins = std::make_shared<PluginSet>());

// The steps of load_text(), for a program that keeps plugins while texts change.
std::unique_ptr<Project> load_project_text(const std::string& path, std::string text,
                                           const LoadOptions& options, Diagnostics& diagnostics);
// Whether all are there that the options and `project`, which may be null, ask for.
struct LoadedPlugins {
  std::shared_ptr<PluginSet> plugins;
  bool are_all = true;
  Diagnostics messages = {};
};
LoadedPlugins load_plugins(const Project* project, const LoadOptions& options,
                           std::shared_ptr<PluginSet> plugins = std::make_shared<PluginSet>());
struct Meaning {
  Definition definition;
  std::vector<Property> properties;
};
[[nodiscard]] tl::expected<Meaning, LoadFailure> meaning_of(const Project* project,
                                                            const LoadedPlugins& plugins,
                                                            const LoadOptions& options,
                                                            Diagnostics& diagnostics);

// For who takes each tree of a project for itself. The objects refer to each other.
struct LoadedTrees {
  std::shared_ptr<PluginSet> plugins;
  std::unique_ptr<Project> project;
  std::unique_ptr<TreesOfProject> trees;
};
// As load(); `text`: in place of the main file. `diagnostics` must outlive what is returned.
[[nodiscard]] tl::expected<LoadedTrees, LoadFailure> load_trees(
    const std::string& path, const std::optional<std::string>& text, const LoadOptions& options,
    Diagnostics& diagnostics, std::shared_ptr<PluginSet> plugins);

// All that a run needs; the documents and the definition are gone.
struct Runnable {
  std::shared_ptr<PluginSet> plugins;
  std::vector<DeclaredArgument> arguments;
  Tree tree;
  std::vector<Property> properties;
  StartValues values;  // that the options gave
};

[[nodiscard]] Runnable make_runnable(Loaded loaded);

}  // namespace lockstep::host
