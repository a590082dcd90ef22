#include "cli/tools/new/new.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "author/scaffold/new_files.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "run/loading/plugins.h"

namespace lockstep::host {

void add_dry_run(CLI::App& app, bool& is_dry_run) {
  app.add_flag("--dry-run", is_dry_run, "Only list the files, and write nothing");
}

void add_language(CLI::App& app, std::string& language) {
  app.add_option("--lang", language,
                 "The language of the plugin; btcpp: C++ nodes for BehaviorTree.CPP")
      ->check(one_of({"c++", "cpp", "c", "python", "rust", "btcpp"}))
      ->capture_default_str();
}

Result<void> check_not_built_in(std::string_view id) {
  const PluginSet none;
  for (const LanguageRules* rules : languages()) {
    if (make_catalog(none, *rules).find(std::string(id)) == nullptr) continue;
    return problem(fmt::format("'{}' is a node of lockstep", id),
                   fmt::format("take another name; `lockstep nodes {}` shows it", id));
  }
  return {};
}

int make_files(const NewFiles& files, bool is_dry_run, std::span<const std::string> next) {
  const auto made = is_dry_run ? check_free(files) : write_new(files);
  if (!made) return refuse(made.error());
  std::string list;
  for (const NewFile& file : files) list += file.path.lexically_normal().string() + '\n';
  const int code = write_results(list);
  if (is_dry_run || code != kExitSuccess) return code;
  print_next(next);
  return kExitSuccess;
}

namespace {

std::function<int()> define_new(CLI::App& app) {
  app.require_subcommand(1);
  const std::vector<NewPart> parts{define_new_project(app), define_new_plugin(app),
                                   define_new_leaf(app),    define_new_node(app),
                                   define_new_tree(app),    define_new_leaves(app)};
  return [parts] {
    for (const NewPart& part : parts) {
      if (part.app->parsed()) return part.run();
    }
    return static_cast<int>(kExitUsage);
  };
}

}  // namespace

extern const Command kNewCommand{
    "new", "Make a project, a plugin, a leaf, a tree or a leaf model to start from",
    "What is made builds, runs and passes its tests as it is. No file is overwritten.\n"
    "The files are listed on stdout; what to type next is on stderr.\n"
    "Exit code: 0 made, 2 a name is taken or illegal, a file is there already, or usage;\n"
    "leaves: 3 an invalid tree, 4 plugin refused.\n"
    "\n"
    "Examples:\n"
    "  lockstep new project robot\n"
    "  lockstep new plugin gripper --lang python\n"
    "  lockstep new leaf OpenDoor --port goal:string --port speed:double=0.5\n"
    "  lockstep new node TryAll --kind control\n"
    "  lockstep new tree patrol\n"
    "  lockstep new leaves patrol.xml",
    define_new};

}  // namespace lockstep::host
