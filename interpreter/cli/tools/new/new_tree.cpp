#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "author/scaffold/names.h"
#include "cli/checks.h"
#include "cli/tools/new/new.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

struct TreeOptions {
  std::string name;
  std::string language = "lockstep";
  std::string plugin;
  bool is_dry_run = false;
};

// "grip", "grip.so" and "grip.py" name a plugin; of a program the extension stays.
Result<std::string> plugin_named(const std::string& text) {
  const fs::path plugin = text;
  if (text.empty()) return text;
  if (const auto name = check_file_name("plugin", plugin.stem().string()); !name)
    return tl::unexpected(name.error());
  return plugin.extension() == ".so" ? plugin.stem().string() : text;
}

// Where the file of the plugin is, or will be.
std::string folder_of_plugin(const std::string& plugin) {
  const std::string file = fs::path(plugin).has_extension() ? plugin : plugin + ".so";
  return fs::exists(file) && !fs::exists(fs::path("build") / file) ? "." : "build";
}

int new_tree(const TreeOptions& options) {
  std::string name = options.name;
  if (name.ends_with(".xml")) name.resize(name.size() - 4);
  if (const auto checked = check_file_name("tree", name); !checked) return refuse(checked.error());
  const auto plugin = plugin_named(options.plugin);
  if (!plugin) return refuse(plugin.error());
  const fs::path folder = fs::is_directory("trees") ? "trees" : "";
  const NewTree tree{name, options.language == "btcpp4", *plugin, folder};
  const std::string path = plugin->empty() ? "" : " --plugin-path " + folder_of_plugin(*plugin);
  const auto line = [&](const char* command, const char* end) {
    return fmt::format("{} {} {}{}", program_word(), command, (folder / (tree.name + end)).string(),
                       path);
  };
  const std::vector<std::string> next{line("run", ".xml"), line("test", ".test.xml")};
  return make_files(plan_tree(tree), options.is_dry_run, next);
}

}  // namespace

NewPart define_new_tree(CLI::App& app) {
  const auto options = std::make_shared<TreeOptions>();
  CLI::App* command = app.add_subcommand(
      "tree", "A tree and its scenarios: in the folder trees if there is one, otherwise here");
  command->add_option("name", options->name, "Of the files: NAME.xml and NAME.test.xml")
      ->type_name("NAME")
      ->required();
  command
      ->add_option("--language", options->language, "lockstep, or btcpp4: that of BehaviorTree.CPP")
      ->check(one_of({"lockstep", "btcpp4"}))
      ->capture_default_str();
  command
      ->add_option("--plugin", options->plugin,
                   "The plugin whose leaves the tree uses; for a process plugin the name of the "
                   "file: grip.py")
      ->type_name("NAME");
  add_dry_run(*command, options->is_dry_run);
  command->footer("Example: lockstep new tree patrol");
  return {command, [options] { return new_tree(*options); }};
}

}  // namespace lockstep::host
