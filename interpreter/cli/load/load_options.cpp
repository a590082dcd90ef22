#include "cli/load/load_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "base/core/clock.h"
#include "base/core/value.h"
#include "base/core/wording.h"
#include "base/system/freed_memory.h"
#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "leaves/remote/json_lines/orphans.h"
#include "run/loading/project_file.h"
#include "run/plugin_thread.h"

namespace lockstep::host {
namespace {

// "name=value" pairs; a later one replaces an earlier one.
Arguments parse_pairs(const std::vector<std::string>& pairs, std::string_view option,
                      Diagnostics& diagnostics) {
  Arguments map;
  for (const std::string& pair : pairs) {
    const auto equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      diagnostics.error("bad-option"_code, {},
                        fmt::format("{} {}: expected name=value", option, pair));
    } else {
      map[pair.substr(0, equals)] = pair.substr(equals + 1);
    }
  }
  return map;
}

// "failure" or "failure:2.5"
std::optional<Mock> parse_mock(std::string_view text) {
  Mock mock;
  if (const auto colon = text.find(':'); colon != std::string_view::npos) {
    const auto seconds = parse_double(text.substr(colon + 1));
    if (!seconds || *seconds < 0 || *seconds > 1e9) return std::nullopt;
    mock.seconds = *seconds;
    text = text.substr(0, colon);
  }
  if (text == "success") {
    mock.result = Status::Success;
  } else if (text == "failure") {
    mock.result = Status::Failure;
  } else if (text == "running") {
    mock.result = Status::Running;
  } else {
    return std::nullopt;
  }
  return mock;
}

Mocks parse_mocks(const LoadCommandOptions& options, Diagnostics& diagnostics) {
  Mocks mocks;
  for (const auto& [id, text] : parse_pairs(options.mock_leaves, "--mock-leaf", diagnostics)) {
    if (const auto mock = parse_mock(text)) {
      mocks[id] = *mock;
    } else {
      diagnostics.error("bad-option"_code, {},
                        fmt::format("--mock-leaf {}={}: no result", id, text),
                        "success, failure or running, then perhaps a time: failure:2.5");
    }
  }
  return mocks;
}

}  // namespace

void note_project_plugins(const PluginSet& plugins, const PluginOptions& options) {
  const auto is_build = [&](const std::string& directory) {
    std::error_code none;
    return std::filesystem::equivalent(directory, options.project_build, none);
  };
  if (std::ranges::any_of(options.directories, is_build)) return;  // the user knows
  const std::vector<PluginSet::Info> list = plugins.list();
  std::vector<std::string_view> names;
  for (const PluginSet::Info& it : list) {
    const bool is_given = std::ranges::find(options.plugins, it.path) != options.plugins.end();
    if (!is_given && std::filesystem::path(it.path).parent_path() == options.project_build) {
      names.push_back(it.name);
    }
  }
  if (names.empty()) return;
  print_note(fmt::format("from the directory '{}' here: {} {}", options.project_build,
                         names.size() == 1 ? "the plugin" : "the plugins", listed(names)));
}

void add_plugin_options(CLI::App& app, PluginOptions& options) {
  options.project_build = "build";
  app.add_option("--plugin", options.plugins,
                 "Load this plugin: a file (.so), or a name to search for; may be repeated")
      ->type_name("FILE|NAME")
      ->allow_extra_args(false);
  app.add_option(
         "--plugin-path", options.directories,
         "Search plugins in this directory first; may be repeated (last: build, in the working "
         "directory)")
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

void add_program_option(CLI::App& app, PluginOptions& options) {
  app.add_flag("--run-programs", options.run_programs,
               "Start process plugins to learn which leaves they have. Otherwise the leaves are "
               "read from a file next to the plugin: grip.leaves.json for grip.py");
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
  app.add_option("--ros-package", options.ros_packages,
                 "The share directory of the ROS package NAME, for <include ros_pkg=\"NAME\">; may "
                 "be repeated (default: search AMENT_PREFIX_PATH)")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false);
  add_plugin_options(app, options.plugins);
}

namespace {

void add_mock_output(CLI::App& app, LoadCommandOptions& options) {
  app.add_option("--mock-output", options.mock_outputs,
                 "With --mock: the value that leaves write to this output when they succeed; "
                 "ID.PORT=VALUE is for one leaf; may be repeated")
      ->type_name("PORT=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

void add_mock_option(CLI::App& app, LoadCommandOptions& options) {
  app.add_flag("--mock", options.mock, "Accept nodes that no plugin has, and trees of other files");
  add_mock_output(app, options);
}

void add_mock_options(CLI::App& app, LoadCommandOptions& options) {
  app.add_flag("--mock", options.mock,
               "Replace nodes that no plugin has by mocks: an action succeeds after one second, a "
               "condition at once; outputs are 0, false or an empty text");
  app.add_option("--mock-leaf", options.mock_leaves,
                 "With --mock: the result of the leaf ID (success, failure or running) and the "
                 "seconds until then; also replaces a leaf of a plugin; may be repeated")
      ->type_name("ID=RESULT[:S]")
      ->allow_extra_args(false);
  add_mock_output(app, options);
}

namespace {

LoadOptions given_options(const std::string& path, const LoadCommandOptions& options,
                          Diagnostics& diagnostics) {
  const bool mocks = options.mock || !options.mock_leaves.empty() || !options.mock_outputs.empty();
  return with_project_file(
      path,
      {.plugins = options.plugins,
       .arguments = parse_pairs(options.arguments, "--arg", diagnostics),
       .values = parse_pairs(options.values, "--set", diagnostics),
       .later = options.later,
       .main_tree = options.main_tree,
       .main_file = options.main_file,
       .ros_packages = parse_pairs(options.ros_packages, "--ros-package", diagnostics),
       .unknown = mocks ? MissingNodes::AreMocked : options.unknown,
       .mocks = parse_mocks(options, diagnostics),
       .mock_outputs = parse_pairs(options.mock_outputs, "--mock-output", diagnostics),
       .may_lack_main = options.may_lack_main,
       .is_part = options.is_part,
       .elsewhere = options.elsewhere,
       .library = options.library},
      diagnostics);
}

}  // namespace

tl::expected<LoadedTrees, LoadFailure> load_trees_given(const std::string& path,
                                                        const LoadCommandOptions& options,
                                                        Diagnostics& diagnostics,
                                                        std::shared_ptr<PluginSet> plugins) {
  return load_trees(path, options.text, given_options(path, options, diagnostics), diagnostics,
                    std::move(plugins));
}

tl::expected<Loaded, LoadFailure> load_given(const std::string& path,
                                             const LoadCommandOptions& options,
                                             Diagnostics& diagnostics,
                                             std::shared_ptr<PluginSet> plugins) {
  keep_freed_memory();
  watch_this_thread(from_seconds(options.plugins.hang_limit));
  const LoadOptions load_options = given_options(path, options, diagnostics);
  auto loaded = options.text
                    ? load_text(path, *options.text, load_options, diagnostics, std::move(plugins))
                    : load(path, load_options, diagnostics, std::move(plugins));
  if (loaded && std::ranges::any_of(loaded->plugins->list(), &PluginSet::Info::isolated)) {
    take_over_orphans();
  }
  if (loaded) note_project_plugins(*loaded->plugins, options.plugins);
  return loaded;
}

int exit_code_of(LoadFailure failure) {
  if (failure == LoadFailure::Options) return kExitUsage;
  if (failure == LoadFailure::NothingToRun) return kExitSuccess;
  return failure == LoadFailure::PluginRefused ? kExitPluginRefused : kExitInvalidTree;
}

}  // namespace lockstep::host
