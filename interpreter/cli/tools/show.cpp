#include <CLI/CLI.hpp>

#include "base/terminal/terminal.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/load/load_options.h"
#include "cli/load/tree_argument.h"
#include "describe/tree_drawing.h"

namespace lockstep::host {
namespace {

struct ShowOptions {
  LoadCommandOptions load;
  std::string tree;
  std::string format = "text";
};

std::string draw(const Definition& definition, const std::string& format) {
  if (format == "dot") return tree_as_dot(definition);
  if (format == "mermaid") return tree_as_mermaid(definition);
  return tree_as_text(definition, !has_unicode());
}

int show(const ShowOptions& options) {
  keep_stdout_for_results();
  Diagnostics diagnostics;
  LoadCommandOptions load = options.load;
  load.unknown = MissingNodes::AreNoted;
  const auto loaded = load_given(options.tree, load, diagnostics);
  print_diagnostics(diagnostics, Severity::Error);
  if (!loaded) return exit_code_of(loaded.error());
  return write_results(draw(loaded->definition, options.format));
}

std::function<int()> define_show(CLI::App& app) {
  const auto options = std::make_shared<ShowOptions>();
  add_tree_argument(app, options->tree, "Tree file; - is stdin");
  app.add_option("--format", options->format, "text, dot: for Graphviz, or mermaid")
      ->check(one_of({"text", "dot", "mermaid"}))
      ->capture_default_str();
  add_load_options(app, options->load);
  add_mock_option(app, options->load);
  add_program_option(app, options->load.plugins);
  return [options] { return show(*options); };
}

}  // namespace

extern const Command kShowCommand{
    "show", "Draw a tree as it will run, with subtrees expanded and arguments replaced",
    "The text is drawn with ASCII when the locale is not UTF-8.\n"
    "Exit code: 0 drawn, 3 invalid tree, 4 plugin refused, 2 usage, 6 a plugin\n"
    "crashed or hung.\n"
    "\n"
    "Examples:\n"
    "  lockstep show --example door_pulling\n"
    "  lockstep show --example door_pulling --arg barriers=0.5\n"
    "  lockstep show --format dot --example door_pulling | dot -Tsvg > door.svg",
    define_show};

}  // namespace lockstep::host
