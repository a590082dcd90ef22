#include "cli/load/given_leaves.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <utility>

#include "cli/console.h"
#include "language/document/file.h"
#include "tree/pace.h"

namespace lockstep::host {

void add_leaves_option(CLI::App& app, std::string& file) {
  app.add_option(
         "--leaves", file,
         "Replace the plugins: a script of the leaves as `lockstep verify` writes it, which sets "
         "the rate and the length of the run, or a leaf model, from which the seed chooses")
      ->type_name("FILE");
}

bool GivenLeaves::read(const std::string& path) {
  constexpr std::size_t kMost = std::size_t{64} << 20u;
  path_ = path;
  auto text = read_file(path, kMost, FileKinds::RegularOrPipe);
  if (!text) {
    print_error(
        fmt::format("--leaves: cannot read '{}': {}", printable(path), text.error().message),
        text.error().hint);
    return false;
  }
  text_ = std::move(*text);
  if (!is_leaf_file(text_)) return read_scripts();
  Diagnostics diagnostics;
  file_ = read_leaf_file(path, text_, diagnostics);
  print_diagnostics(diagnostics, Severity::Warning);
  return file_ != nullptr && !diagnostics.has_errors();
}

bool GivenLeaves::read_scripts() {
  auto parsed = parse_leaf_scripts(text_);
  if (!parsed) {
    const LeafScriptError& wrong = parsed.error();
    tell(wrong.line, wrong.column, wrong.message, wrong.hint);
    return false;
  }
  scripts_ = std::move(*parsed);
  return true;
}

void GivenLeaves::tell(std::uint32_t line, std::uint32_t column, const std::string& message,
                       const std::string& hint) const {
  Diagnostics diagnostics;
  diagnostics.error("bad-leaf-script"_code, {path_, line, column}, message, hint);
  print_diagnostics(diagnostics, Severity::Error);
}

void GivenLeaves::take_over(Definition& definition) {
  // A script has each tick, as it was without pace: a finding of verify is one.
  if (file_ == nullptr && paces(definition)) {
    ignore_pace(definition);
    if (!std::exchange(told_of_pace_, true))
      print_note("--leaves: pace has no effect, since a script states each tick of its leaves");
  }
  given_.emplace_back().played.take_over(definition);
}

bool GivenLeaves::give(const Tree& tree) {
  Given& given = given_.back();
  if (file_ != nullptr) {
    Diagnostics diagnostics;
    std::vector<NodeProblem> problems;
    given.models = make_models(tree, file_.get(), diagnostics, problems);
    for (const NodeProblem& it : problems) {
      diagnostics.error("bad-leaf-model"_code, {path_}, tree.path(it.node) + ": " + it.message,
                        it.hint);
    }
    print_diagnostics(diagnostics, Severity::Warning);
    given.played.set_models(tree, given.models);
    return !diagnostics.has_errors();
  }
  if (const auto wrong = PlayedLeaves::check(scripts_, tree)) {
    tell(line_of_leaf(text_, wrong->leaf), 1, wrong->message, wrong->hint);
    return false;
  }
  given.played.set_scripts(scripts_);
  return true;
}

}  // namespace lockstep::host
