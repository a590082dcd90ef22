#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <vector>

#include "author/convert/convert.h"
#include "author/convert/since_4.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/tree_argument.h"
#include "language/document/file.h"
#include "run/loading/load.h"
#include "run/loading/plugins.h"
#include "tree/check/models.h"
#include "verify/check/advice.h"

namespace lockstep::host {
namespace {

struct ConvertOptions {
  std::string tree;
  std::string to;
};

// All that `check --mock` finds without plugins.
struct Checked {
  Checked(const std::string& name, std::string text) {
    LoadOptions options;
    options.unknown = MissingNodes::AreMocked;
    options.may_lack_main = true;
    plugins.plugins = std::make_shared<PluginSet>();
    project = load_project_text(name, std::move(text), options, found);
    if (!project) return;
    if (auto all = meaning_of(project.get(), plugins, options, found))
      definition = std::move(all->definition);
  }

  Diagnostics found;
  LoadedPlugins plugins;             // none
  std::unique_ptr<Project> project;  // the definition refers to it
  std::optional<Definition> definition;
};

std::vector<Diagnostic> faults_of(Checked&& checked) {
  Diagnostics advice;
  if (!checked.definition || checked.found.has_errors()) return {};
  add_advice(*checked.project, *std::move(checked.definition), AdviceEffort::Certain, advice);
  std::vector<Diagnostic> faults(advice.all().begin(), advice.all().end());
  std::erase_if(faults, [](const Diagnostic& it) { return it.code.text() != "always-fault"; });
  return faults;
}

// The errors of the result, and what is a fault in each run of one of both. For example, a SubTree
// gives its tree ready="true", which is a text for BehaviorTree.CPP and a bool here.
void check_result(const std::string& name, Checked&& before, const std::string& result,
                  Diagnostics& diagnostics) {
  const auto before_faults = faults_of(std::move(before));
  for (const Diagnostic& it : before_faults) {
    diagnostics.warning("not-the-same"_code, it.location, it.message,
                        "the types of entries are others in the result, so look at it there");
  }
  Checked after(name, result);
  for (const Diagnostic& it : after.found.all()) {
    if (it.severity != Severity::Error || it.location.file != name) continue;
    diagnostics.warning(
        "not-convertible"_code, {name},
        fmt::format("line {} of the result has an error: {}", it.location.line, it.message),
        it.hint);
  }
  if (!before_faults.empty()) return;
  for (const Diagnostic& it : faults_of(std::move(after))) {
    diagnostics.warning("not-the-same"_code, {name},
                        fmt::format("line {} of the result: {}", it.location.line, it.message),
                        it.hint);
  }
}

std::optional<std::string> converted(const ConvertOptions& options, Diagnostics& diagnostics) {
  const bool is_stdin = options.tree == "-";
  auto text = is_stdin ? read_stdin(Document::kMaxBytes)
                       : read_file(options.tree, Document::kMaxBytes, FileKinds::RegularOrPipe);
  const std::string name = is_stdin ? "stdin" : options.tree;
  if (!text) {
    diagnostics.error("unreadable-file"_code, {name}, "cannot be read: " + text.error().message);
    return std::nullopt;
  }
  const auto document = Document::parse(name, std::move(*text), diagnostics);
  if (!document || diagnostics.has_errors()) return std::nullopt;
  const LanguageRules& from = document->rules();
  const auto is_meant = [&](const LanguageRules* it) {
    return options.to.empty() ? it != &from : it->name == options.to;
  };
  const LanguageRules& to = **std::ranges::find_if(languages(), is_meant);
  const bool is_older = &to == &from && is_older_form(*document);
  if (&to == &from && !is_older) {
    diagnostics.error("wrong-language"_code, {name}, "is in that language already");
    return std::nullopt;
  }
  const PluginSet none;
  const Catalog from_nodes = make_catalog(none, from), to_nodes = make_catalog(none, to);
  Sources sources;
  sources.add(document->source());
  const Reporter report(sources, diagnostics);
  Checked before(name, std::string(document->source()->text()));
  Diagnostics told_by_check;
  const Models models = before.project
                            ? read_models(*before.project, {before.project->sources, told_by_check})
                            : Models();
  const Definition* const meaning = before.definition ? &*before.definition : nullptr;
  auto result =
      is_older ? convert_since_4(*document, to_nodes, report)
               : convert(*document,
                         {from, to, from_nodes, to_nodes, models, meaning, before.project.get()},
                         report);
  if (result && !before.found.has_errors())
    check_result(name, std::move(before), *result, diagnostics);
  return result;
}

int convert_file(const ConvertOptions& options) {
  keep_stdout_for_results();
  Diagnostics diagnostics;
  const auto text = converted(options, diagnostics);
  print_diagnostics(diagnostics, Severity::Note);
  if (!text) return kExitInvalidTree;
  return write_results(*text);
}

std::function<int()> define_convert(CLI::App& app) {
  const auto options = std::make_shared<ConvertOptions>();
  add_tree_argument(app, options->tree, "Tree file; - is stdin");
  app.add_option("--to", options->to, "lockstep or btcpp4 (default: the one that it is not in)")
      ->check(one_of({"lockstep", "btcpp4"}));
  return [options] { return convert_file(*options); };
}

}  // namespace

extern const Command kConvertCommand{
    "convert", "Convert a tree file to the other language: lockstep's, or that of BehaviorTree.CPP",
    "Comments, whitespace and order stay. A node or script that the other language cannot express\n"
    "is an error. What only lockstep reads (<arg>, <property>, ${name}) is kept or left out, with\n"
    "a warning.\n"
    "Files that it includes are converted one by one. Nodes of plugins are copied.\n"
    "A file for version 3 of BehaviorTree.CPP is converted to version 4 with --to btcpp4.\n"
    "Exit code: 0 printed, 2 usage, 3 the file cannot be read or converted.\n"
    "\n"
    "Examples:\n"
    "  lockstep convert dock.xml > dock_lockstep.xml\n"
    "  lockstep convert --to btcpp4 --example door_pulling > door_pulling.xml",
    define_convert};

}  // namespace lockstep::host
