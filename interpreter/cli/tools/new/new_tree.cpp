#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "authoring/scaffold/names.h"
#include "cli/checks.h"
#include "cli/tools/new/new.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

struct TreeOptions {
  std::string name;
  std::string language = "lockstep";
  bool is_dry_run = false;
};

int new_tree(const TreeOptions& options) {
  if (const auto name = check_file_name("tree", options.name); !name) return refuse(name.error());
  NewTree tree{options.name, options.language == "btcpp4"};
  if (fs::is_directory("trees")) tree.folder = "trees";
  const fs::path file = tree.folder / (tree.name + ".xml");
  const std::vector<std::string> next{
      fmt::format("{} run {}", program_word(), file.string()),
      fmt::format("{} test {}", program_word(),
                  (tree.folder / (tree.name + ".test.xml")).string())};
  return make_files(plan_tree(tree), options.is_dry_run, next);
}

}  // namespace

NewPart define_new_tree(CLI::App& app) {
  const auto options = std::make_shared<TreeOptions>();
  CLI::App* command = app.add_subcommand(
      "tree", "A tree and its scenarios: in the folder trees, if there is one, else here");
  command->add_option("name", options->name, "Of the files: NAME.xml and NAME.test.xml")
      ->type_name("NAME")
      ->required();
  command
      ->add_option("--language", options->language, "lockstep, or btcpp4: that of BehaviorTree.CPP")
      ->check(one_of({"lockstep", "btcpp4"}))
      ->capture_default_str();
  add_dry_run(*command, options->is_dry_run);
  command->footer("Example: lockstep new tree patrol");
  return {command, [options] { return new_tree(*options); }};
}

}  // namespace lockstep::host
