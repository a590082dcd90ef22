#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "author/format/format.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "cli/load/tree_argument.h"
#include "cli/tools/new/new.h"
#include "leaves/play/played_leaves.h"
#include "verify/leaf_model_text.h"
#include "verify/verifiable.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

struct NewLeavesOptions {
  LoadCommandOptions load;
  std::string tree, out;
  bool is_dry_run = false;
};

int new_leaves(const NewLeavesOptions& options) {
  keep_stdout_for_results();
  Diagnostics diagnostics;
  LoadCommandOptions load = options.load;
  load.mock = true;
  auto loaded = load_given(options.tree, load, diagnostics);
  print_diagnostics(diagnostics, Severity::Error);
  if (!loaded) return exit_code_of(loaded.error());
  const bool has_mocks = std::ranges::any_of(
      loaded->definition.nodes, [](const DefinitionNode& it) { return it.type->mock != nullptr; });
  PlayedLeaves played;  // as for `verify`: nodes that no plugin has are leaves, too
  played.take_over(loaded->definition);
  const Runnable runnable = make_runnable(std::move(*loaded));
  std::vector<NodeProblem> reported_by_verify;
  const Observed observed = observed_by(runnable.tree, runnable.properties, reported_by_verify);
  const fs::path tree = options.tree == "-" ? "stdin.xml" : options.tree;
  const fs::path file =
      options.out.empty() ? fs::path(tree).replace_extension(".leaves.xml") : fs::path(options.out);
  const std::string mock = has_mocks ? " --mock" : "";
  const std::string words = in_shell(options.tree) + mock + " --leaves " + in_shell(file.string());
  const std::vector<std::string> next{program_word() + " verify " + words,
                                      program_word() + " run " + words + " --clock virtual"};
  return make_files(
      {{file, new_leaf_model(runnable.tree, tree.filename().string(), observed.entries)}},
      options.is_dry_run, next);
}

}  // namespace

std::string new_leaf_model(const Tree& tree, const std::string& tree_file,
                           const std::vector<std::uint32_t>& observed) {
  std::string text = leaf_model_text(tree, tree_file, observed);
  Diagnostics none;
  const auto document = Document::parse("", text, none);
  if (document == nullptr) return text;
  const auto edit = format(*document, {});
  return edit ? edit->apply(text) : text;
}

NewPart define_new_leaves(CLI::App& app) {
  const auto options = std::make_shared<NewLeavesOptions>();
  CLI::App* command = app.add_subcommand(
      "leaves", "A leaf model of a tree: what its leaves may do, for `verify` and `run --leaves`");
  add_tree_argument(*command, options->tree, "Tree file; - is stdin");
  command
      ->add_option("--out", options->out,
                   "The file to write (default: TREE.leaves.xml, next to the tree)")
      ->type_name("FILE");
  add_load_options(*command, options->load);
  add_program_option(*command, options->load.plugins);
  add_dry_run(*command, options->is_dry_run);
  command->footer(
      "The model has a row for each type of leaves that no plugin describes. As it is, it allows\n"
      "all that such a leaf may do; edit it to what your robot does.\n"
      "Example: lockstep new leaves tree.xml");
  return {command, [options] { return new_leaves(*options); }};
}

}  // namespace lockstep::host
