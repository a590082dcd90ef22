#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "base/terminal/outlet.h"
#include "cli/check_formats.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "verify/check/advice.h"

namespace lockstep::host {
namespace {

struct CheckOptions {
  LoadCommandOptions load;
  std::vector<std::string> trees;
  std::string format = "text";
  bool strict = false;
  bool together = false;
};

using CheckWriter = std::string (*)(std::span<const Diagnostic>);

// Null: text, for people.
CheckWriter writer_of(const std::string& format) {
  if (format == "json") return as_json;
  return format == "github" ? as_github : nullptr;
}

std::vector<Diagnostic> sorted(Diagnostics diagnostics) {
  diagnostics.sort();
  return diagnostics.all();
}

// For people. `written` is the exit code of what went to stdout so far.
// `is_told`: it has errors, and perhaps another file reported them.
void print_checked(const std::string& tree, Diagnostics& diagnostics, bool is_told, int code,
                   int& written) {
  print_diagnostics(diagnostics, Severity::Note);
  const std::string name = printable(tree == "-" ? "stdin" : tree);
  if (code == kExitSuccess) {
    if (written == kExitSuccess) written = write_results(name + ": ok\n");
  } else if (is_told && !diagnostics.has_errors()) {
    messages().say(fmt::format("{}: a file that it uses has the errors above\n", name));
  } else if (!diagnostics.has_errors()) {
    const auto warnings = counted(diagnostics.count(Severity::Warning), "warning");
    messages().say(fmt::format("{}: {}, an error with --strict\n", name, warnings));
  }
}

// The command that reads a file which stands beside trees, so that trees/*.xml may name it too.
// "": it is a tree.
std::string other_command(const std::string& file) {
  if (file.ends_with(".test.xml")) return "`lockstep test`";
  return file.ends_with(".leaves.xml") ? "`lockstep verify --leaves`" : "";
}

// What the given files have and use: `check trees/*.xml` names the files of a project, and what one
// of them lacks may be in another one. Files are known by file_identity().
class Neighbors {
 public:
  void add(const Project& project) {
    for (const auto& document : project.documents) {
      const std::string file = file_identity(document->source()->path());
      if (document != project.documents.front()) included_.insert(file);
      add(*document, file);
    }
  }

  const TreeIds& trees() const { return trees_; }
  // Another one includes it, or uses a tree of it.
  bool is_part(const std::string& path) const {
    const std::string file = file_identity(path);
    if (included_.contains(file)) return true;
    const auto trees = trees_in_.find(file);
    return trees != trees_in_.end() && std::ranges::any_of(trees->second, [&](const auto& id) {
             const auto users = users_.find(id);
             return users != users_.end() &&
                    std::ranges::any_of(users->second, [&](const auto& it) { return it != file; });
           });
  }

 private:
  void add(const Document& document, const std::string& file) {
    const auto elements = document.elements();
    for (const std::uint32_t tree : children_in(elements, 0)) {
      if (elements[tree].tag != "BehaviorTree") continue;
      for (std::uint32_t element = tree; element < elements[tree].end; ++element) {
        const Attribute* id = document.find_attribute(element, "ID");
        if (id == nullptr) continue;
        if (element == tree) {
          trees_.emplace(id->value);
          trees_in_[file].emplace(id->value);
        } else if (elements[element].tag == "SubTree") {
          users_[std::string(id->value)].insert(file);
        }
      }
    }
  }

  TreeIds trees_;
  std::set<std::string> included_;
  std::map<std::string, TreeIds> trees_in_;             // each file
  std::map<std::string, std::set<std::string>> users_;  // the files that use a tree
};

Neighbors neighbors_of(const std::vector<std::string>& files) {
  Neighbors neighbors;
  if (files.size() < 2) return neighbors;
  for (const std::string& file : files) {
    std::error_code unused;
    if (!other_command(file).empty() || !std::filesystem::is_regular_file(file, unused)) continue;
    Diagnostics told_later;
    if (const auto project = load_project(file, {}, told_later)) neighbors.add(*project);
  }
  return neighbors;
}

// What is checked: files, and the tree files of folders.
struct Checked {
  std::vector<std::string> files;
  std::shared_ptr<Library> library;  // of those that are checked together; null: none are
};

Checked find_files(const CheckOptions& options, Diagnostics& diagnostics) {
  Checked checked;
  const auto is_folder = [](const std::string& it) {
    std::error_code unused;
    return std::filesystem::is_directory(it, unused);
  };
  if (options.together || std::ranges::any_of(options.trees, is_folder)) {
    checked.library = std::make_shared<Library>();
  }
  for (const std::string& tree : options.trees) {
    if (!is_folder(tree)) {
      if (checked.library != nullptr && Library::may_be_tree_file(tree)) {
        checked.library->add_file(tree);
      }
      checked.files.push_back(tree);
      continue;
    }
    const auto files = checked.library->add_folder(tree, diagnostics);
    if (files.empty() && !diagnostics.has_errors()) {
      diagnostics.error("no-tree"_code, {tree}, "the folder has no tree files",
                        "their names end with .xml");
    }
    std::ranges::copy(files, std::back_inserter(checked.files));
  }
  return checked;
}

// Files that are checked together have the messages of those that they use.
class Told {
 public:
  Diagnostics only_new(const Diagnostics& diagnostics) {
    Diagnostics fresh;
    for (const Diagnostic& it : diagnostics.all()) {
      const SourceLocation& at = it.location;
      if (told_.emplace(at.file, at.line, at.column, it.message).second) fresh.add(it);
    }
    return fresh;
  }

 private:
  std::set<std::tuple<std::string, std::uint32_t, std::uint32_t, std::string>> told_;
};

int check(const CheckOptions& options) {
  keep_stdout_for_results();
  const CheckWriter write = writer_of(options.format);
  LoadCommandOptions load = options.load;
  if (!options.strict) load.unknown = MissingNodes::AreNoted;
  load.may_lack_main = true;
  Diagnostics in_folders;
  const Checked checked = find_files(options, in_folders);
  const Neighbors neighbors = neighbors_of(checked.files);
  load.library = checked.library;
  if (load.library == nullptr) load.elsewhere = neighbors.trees();
  std::vector<Diagnostic> all;
  Told told;
  int worst = in_folders.has_errors() ? kExitInvalidTree : kExitSuccess, written = kExitSuccess;
  if (write == nullptr) {
    print_diagnostics(in_folders, Severity::Note);
  } else {
    std::ranges::move(sorted(std::move(in_folders)), std::back_inserter(all));
  }
  for (const std::string& tree : checked.files) {
    Diagnostics diagnostics;
    if (const std::string other = other_command(tree); !other.empty()) {
      diagnostics.note("wrong-root"_code, {tree}, "is not a tree file", other + " reads it");
      print_diagnostics(diagnostics, Severity::Note);
      continue;
    }
    load.is_part = neighbors.is_part(tree);
    auto loaded = load_given(tree, load, diagnostics);
    if (loaded) {
      add_advice(*loaded->project, std::move(loaded->definition), AdviceEffort::Certain,
                 diagnostics);
    }
    int code = loaded ? kExitSuccess : exit_code_of(loaded.error());
    const bool doubtful = diagnostics.count(Severity::Warning) > 0;
    if (code == kExitSuccess && options.strict && doubtful) code = kExitInvalidTree;
    if (worst == kExitSuccess) worst = code;
    const bool has_errors = diagnostics.has_errors();
    if (load.library != nullptr) diagnostics = told.only_new(diagnostics);
    if (write == nullptr) {
      print_checked(tree, diagnostics, has_errors, code, written);
    } else {
      std::ranges::move(sorted(std::move(diagnostics)), std::back_inserter(all));
    }
  }
  if (write != nullptr) written = write_results(write(all));
  return first_failure(written, worst);
}

std::function<int()> define_check(CLI::App& app) {
  const auto options = std::make_shared<CheckOptions>();
  app.add_option("tree", options->trees, "Tree files, or folders of them; - is stdin")
      ->type_name("TREE.xml")
      ->required();
  app.add_flag("--strict", options->strict,
               "Treat warnings as errors, and nodes that no plugin has: exit code 3");
  app.add_flag("--together", options->together,
               "Let SubTrees find their trees in the other given files, as they do in a folder");
  app.add_option("--format", options->format,
                 "text, or on stdout: json (an array of messages) or github (annotations of a "
                 "workflow)")
      ->check(one_of({"text", "json", "github"},
                     {"sarif", "github annotates the files in a workflow, and json is for others"}))
      ->capture_default_str();
  add_load_options(app, options->load);
  add_mock_option(app, options->load);
  add_program_option(app, options->load.plugins);
  return [options] { return check(*options); };
}

}  // namespace

extern const Command kCheckCommand{
    "check", "Check tree files and report errors and warnings, without running them",
    "Messages go to stderr as file:line:column; in another format they go to stdout.\n"
    "Exit code: 0 no errors, 3 invalid tree, or a warning with --strict, 4 plugin refused,\n"
    "2 usage, 6 a plugin crashed or hung.\n"
    "\n"
    "Examples:\n"
    "  lockstep check trees\n"
    "  lockstep check team.xml truck.xml --together\n"
    "  lockstep check --strict --format github trees/*.xml",
    define_check};

}  // namespace lockstep::host
