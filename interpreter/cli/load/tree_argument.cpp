#include "cli/load/tree_argument.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "cli/console.h"
#include "cli/installed.h"
#include "run/loading/project_file.h"

namespace lockstep::host {
namespace {

std::string check_example(std::string& name) {
  const std::vector<std::string> names = example_names();
  if (std::ranges::find(names, name) != names.end()) return "";
  if (names.empty()) return "the example trees are not installed";
  const std::vector<std::string_view> known(names.begin(), names.end());
  return fmt::format("'{}' is not an example; {}", brief(name), suggest(name, known, "examples"));
}

}  // namespace

CLI::Option* add_tree_argument(CLI::App& app, std::string& tree, const char* description,
                               TreeFile otherwise) {
  CLI::Option* const file = app.add_option("tree", tree, description)->type_name("TREE.xml");
  app.add_option_function<std::string>(
         "--example", [&tree](const std::string& name) { tree = example_file(name).string(); },
         "Use this example tree instead of a file; `lockstep examples` lists them")
      ->type_name("NAME")
      ->check(CLI::Validator(check_example, ""))
      ->excludes(file);
  if (otherwise == TreeFile::MayLack) return file;
  app.parse_complete_callback([&tree, is_read = false]() mutable {
    if (!tree.empty() || std::exchange(is_read, true)) return;
    Diagnostics diagnostics;
    tree = main_file_here(diagnostics);
    if (diagnostics.has_errors()) print_diagnostics(diagnostics, Severity::Error);
    if (tree.empty()) throw CLI::RequiredError("tree");
  });
  return file;
}

}  // namespace lockstep::host
