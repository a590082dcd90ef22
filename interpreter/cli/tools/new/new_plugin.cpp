#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "author/scaffold/names.h"
#include "cli/checks.h"
#include "cli/tools/new/new.h"
#include "leaves/plugin/open/plugin_path.h"
#include "run/loading/plugin_directories.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

struct PluginOptionsOfNew {
  std::string name;  // of a project: its folder
  std::string language = "c++";
  std::string leaf;
  bool is_dry_run = false;
};

Result<void> check_free_name(const std::string& name) {
  const auto found = find_plugin_file(name, plugin_directories({}));
  if (!found) return {};
  return problem(fmt::format("there is a plugin '{}' already: {}", name, *found),
                 "take another name");
}

Result<NewPlugin> request_of(std::string_view what, const std::string& name,
                             const PluginOptionsOfNew& options) {
  const NewPlugin plugin{name, find_language(options.language), options.leaf};
  for (const auto& checked :
       {check_file_name(what, name), check_free_name(name), check_node_id(first_leaf(plugin)),
        check_not_built_in(first_leaf(plugin))}) {
    if (!checked) return tl::unexpected(checked.error());
  }
  return plugin;
}

std::string build_line() {
  return fmt::format("cmake -B build{} && cmake --build build && ctest --test-dir build",
                     configure_option());
}

std::string run_line(const std::string& tree, const std::string& plugin_path) {
  return fmt::format("{} run {} --plugin-path {}", program_word(), tree, plugin_path);
}

bool is_in_project() {
  return fs::is_regular_file("CMakeLists.txt") && fs::is_directory("plugins") &&
         fs::is_directory("trees");
}

int new_plugin(const PluginOptionsOfNew& options) {
  const auto plugin = request_of("plugin", options.name, options);
  if (!plugin) return refuse(plugin.error());
  if (is_in_project()) {
    const std::vector<std::string> next{build_line(),
                                        run_line("trees/" + plugin->name + ".xml", "build")};
    return make_files(plan_plugin_of_project(*plugin, ""), options.is_dry_run, next);
  }
  std::vector<std::string> next{"cd " + plugin->name};
  if (plugin->language->name == "python") {
    next.insert(next.end(), {fmt::format("{} test --plugin-path .", program_word()),
                             run_line("tree.xml", ".")});
  } else {
    next.insert(next.end(), {build_line(), run_line("tree.xml", "build")});
  }
  return make_files(plan_plugin(*plugin, plugin->name), options.is_dry_run, next);
}

int new_project(const PluginOptionsOfNew& options) {
  fs::path folder = options.name;
  if (!folder.has_filename()) folder = folder.parent_path();  // robot/
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(folder, error);
  const std::string name = whole.filename();
  const auto plugin = request_of("project", name, options);
  if (!plugin) return refuse(plugin.error());
  std::vector<std::string> next{build_line(), run_line("trees/" + name + ".xml", "build")};
  if (whole != fs::current_path(error))
    next.insert(next.begin(), "cd " + in_shell(folder.string()));
  return make_files(plan_project(*plugin, folder), options.is_dry_run, next);
}

void add_options(CLI::App& app, PluginOptionsOfNew& options) {
  add_language(app, options.language);
  app.add_option("--leaf", options.leaf,
                 "The first leaf of the plugin (default: Move and the name)")
      ->type_name("ID");
  add_dry_run(app, options.is_dry_run);
}

}  // namespace

NewPart define_new_project(CLI::App& app) {
  const auto options = std::make_shared<PluginOptionsOfNew>();
  CLI::App* command = app.add_subcommand(
      "project", "A project: tree, scenarios, plugin, CMakeLists.txt, README, CI");
  command->add_option("dir", options->name, "Its folder, after which it is called; . is this one")
      ->type_name("DIR")
      ->required();
  add_options(*command, *options);
  command->footer("Example: lockstep new project robot");
  return {command, [options] { return new_project(*options); }};
}

NewPart define_new_plugin(CLI::App& app) {
  const auto options = std::make_shared<PluginOptionsOfNew>();
  CLI::App* command = app.add_subcommand("plugin",
                                         "A plugin with a leaf, a tree and scenarios: in a "
                                         "project, in its folders, otherwise in a new folder");
  command->add_option("name", options->name, "Its name")->type_name("NAME")->required();
  add_options(*command, *options);
  command->footer("Example: lockstep new plugin gripper --lang python --leaf Grip");
  return {command, [options] { return new_plugin(*options); }};
}

}  // namespace lockstep::host
