#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "base/terminal/outlet.h"
#include "cli/check_cuts.h"
#include "cli/check_formats.h"
#include "cli/check_mends.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "cli/told.h"
#include "language/document/file.h"
#include "team/team_run.h"
#include "verify/check/advice.h"

namespace lockstep::host {
namespace {

struct CheckOptions {
  LoadCommandOptions load;
  std::vector<std::string> trees;
  std::string format = "text";
  bool strict = false;
  bool together = false;
  bool fix = false;
  bool cuts = false;  // what leaves do after one
};

using CheckWriter = std::string (*)(std::span<const MendableMessage>);

// Null: text, for people.
CheckWriter writer_of(const std::string& format) {
  if (format == "json") return as_json;
  return format == "github" ? as_github : nullptr;
}

bool has_errors_in(const Diagnostics& diagnostics, const std::string& file) {
  return std::ranges::any_of(diagnostics.all(), [&](const Diagnostic& it) {
    const bool is_here = it.location.file == file || it.location.file.empty();
    return it.severity == Severity::Error && is_here;
  });
}

// For people. `written` is the exit code of what went to stdout so far; `cuts` goes there too.
// `is_told`: it has errors, and perhaps another file reported them, or all are in files that it
// uses.
void print_checked(const std::string& tree, Diagnostics& diagnostics, bool is_told, int code,
                   const std::string& cuts, int& written) {
  print_diagnostics(diagnostics, Severity::Note);
  const std::string file = tree == "-" ? "stdin" : tree, name = printable(file);
  if (code == kExitSuccess) {
    if (written == kExitSuccess) written = write_results(name + ": ok\n" + cuts);
  } else if (is_told && !has_errors_in(diagnostics, file)) {
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
  // `path`: as it was given.
  void add(const std::string& path, const Project& project) {
    const std::string front = file_identity(path);
    given_.emplace(front, path);
    for (const auto& document : project.documents) {
      const std::string file = file_identity(document->source()->path());
      if (document != project.documents.front()) included_by_[file].insert(front);
      add(*document, file);
    }
    if (project.documents.front()->find_attribute(0, "main_tree_to_execute") != nullptr)
      missions_.insert(front);
  }

  const TreeIds& trees() const { return trees_; }
  // Another one includes it, or uses a tree of it.
  bool is_part(const std::string& path) const {
    const std::string file = file_identity(path);
    if (included_by_.contains(file)) return true;
    const auto trees = trees_in_.find(file);
    return trees != trees_in_.end() && std::ranges::any_of(trees->second, [&](const auto& id) {
             const auto users = users_.find(id);
             return users != users_.end() &&
                    std::ranges::any_of(users->second, [&](const auto& it) { return it != file; });
           });
  }

  // The given file with which this one is checked, since it includes it, has what it uses, such as
  // plugins, and is itself no part of another; "": there is none, or this one has a main tree.
  std::string whole_of(const std::string& path) const {
    const std::string file = file_identity(path);
    const auto wholes = included_by_.find(file);
    if (wholes == included_by_.end() || missions_.contains(file)) return "";
    const auto whole = std::ranges::find_if(
        wholes->second, [this](const auto& it) { return !included_by_.contains(it); });
    return whole == wholes->second.end() ? "" : given_.at(*whole);
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
  std::map<std::string, std::set<std::string>> included_by_;
  std::map<std::string, std::string> given_;            // their paths
  std::set<std::string> missions_;                      // which name a main tree
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
    if (const auto project = load_project(file, {}, told_later)) neighbors.add(file, *project);
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

// Robots of a team run different trees, which must declare it in the same way. Where files are
// checked together, one may be of another mission with a team of that name: so it is only noted.
class TeamsOfFiles {
 public:
  void compare(const Loaded& loaded, Diagnostics& diagnostics) {
    const Sources& sources = loaded.project->sources;
    for (const DefinitionNode& node : loaded.definition.nodes) {
      if (!stands_for_robots(*node.type)) continue;
      const auto* const team = loaded.definition.constant(node, "team");
      const auto* const declaration = loaded.definition.constant(node, "declaration");
      if (declaration == nullptr) continue;  // it is for resources
      const SourceLocation place = sources.locate(node.place);
      const auto& name = std::get<std::string>(*team);
      const auto& text = std::get<std::string>(*declaration);
      const auto [known, is_new] = known_.emplace(name, Known{place, text});
      if (is_new || known->second.text == text || known->second.place.file == place.file) continue;
      diagnostics.note(
          "team-differs"_code, place,
          fmt::format("the team '{}' is declared in another way than at {}: '{}' here, "
                      "'{}' there",
                      brief(name), to_text(known->second.place), brief(text),
                      brief(known->second.text)),
          "robots with these trees do not move together");
      return;
    }
  }

 private:
  struct Known {
    SourceLocation place;
    std::string text;
  };
  std::map<std::string, Known> known_;
};

// The files, each with what it takes from the others.
struct CheckedFiles {
  Checked checked;
  Neighbors neighbors;

  LoadCommandOptions options_for(const std::string& tree, const CheckOptions& options) const {
    LoadCommandOptions load = options.load;
    if (!options.strict) load.unknown = MissingNodes::AreNoted;
    load.may_lack_main = true;
    load.library = checked.library;
    if (load.library == nullptr) load.elsewhere = neighbors.trees();
    load.is_part = neighbors.is_part(tree);
    return load;
  }
};

CheckedFiles files_of(const CheckOptions& options, Diagnostics& diagnostics) {
  Checked checked = find_files(options, diagnostics);
  Neighbors neighbors = neighbors_of(checked.files);
  return {std::move(checked), std::move(neighbors)};
}

int mend_files(const CheckOptions& options) {
  Diagnostics told_later;
  const CheckedFiles files = files_of(options, told_later);
  int worst = kExitSuccess;
  for (const std::string& tree : files.checked.files) {
    if (!other_command(tree).empty()) continue;
    worst = first_failure(worst, mend_file(tree, files.options_for(tree, options)));
  }
  return worst;
}

class Checking {
 public:
  explicit Checking(const CheckOptions& options)
      : options_(options), write_(writer_of(options.format)) {}

  int run() {
    Diagnostics in_folders;
    const CheckedFiles files = files_of(options_, in_folders);
    if (in_folders.has_errors()) worst_ = kExitInvalidTree;
    tell(in_folders, std::make_shared<PluginSet>(), {});
    for (const std::string& tree : files.checked.files) {
      Diagnostics diagnostics;
      if (const std::string other = other_command(tree); !other.empty()) {
        diagnostics.note("wrong-root"_code, {tree}, "is not a tree file", other + " reads it");
        print_diagnostics(diagnostics, Severity::Note);
      } else if (const std::string whole = files.neighbors.whole_of(tree); !whole.empty()) {
        tell_part(tree, whole);
      } else {
        check(tree, files.options_for(tree, options_));
      }
    }
    if (write_ != nullptr) written_ = write_results(write_(all_));
    return first_failure(written_, worst_);
  }

 private:
  struct Given {
    std::string name;
    std::optional<std::string> text = {};
  };

  // Stdin can be read only once, and its edits are of its text.
  Given read_once(const std::string& tree) const {
    if (write_ == nullptr || tree != "-") return {tree};
    auto text = read_stdin(Document::kMaxBytes);
    return text ? Given{"stdin", std::move(*text)} : Given{tree};
  }

  void tell_part(const std::string& tree, const std::string& whole) {
    if (write_ != nullptr || written_ != kExitSuccess) return;
    written_ = write_results(
        fmt::format("{}: checked with {}, which includes it\n", printable(tree), printable(whole)));
  }

  void check(const std::string& tree, LoadCommandOptions load) {
    Diagnostics diagnostics;
    const auto plugins = std::make_shared<PluginSet>();
    Given given = read_once(tree);
    load.text = given.text;
    auto loaded = load_given(given.name, load, diagnostics, plugins);
    std::string cuts;
    if (loaded) {
      if (options_.cuts) cuts = cuts_text(loaded->definition);
      teams_.compare(*loaded, diagnostics);
      add_advice(*loaded->project, std::move(loaded->definition), AdviceEffort::Certain,
                 diagnostics);
    }
    int code = loaded ? kExitSuccess : exit_code_of(loaded.error());
    const bool doubtful = diagnostics.count(Severity::Warning) > 0;
    if (code == kExitSuccess && options_.strict && doubtful) code = kExitInvalidTree;
    if (worst_ == kExitSuccess) worst_ = code;
    const bool has_errors = diagnostics.has_errors();
    if (load.library != nullptr) diagnostics = told_.only_new(diagnostics);
    if (write_ == nullptr)
      return print_checked(tree, diagnostics, has_errors, code, cuts, written_);
    tell(diagnostics, plugins, std::move(given));
  }

  void tell(Diagnostics& diagnostics, std::shared_ptr<const PluginSet> plugins, Given given) {
    if (write_ == nullptr) return print_diagnostics(diagnostics, Severity::Note);
    diagnostics.sort();
    MessageMends mends(std::move(plugins));
    if (given.text) mends.set_text(given.name, std::move(*given.text));
    std::ranges::move(mends.of(diagnostics.all()), std::back_inserter(all_));
  }

  const CheckOptions& options_;
  const CheckWriter write_;
  std::vector<MendableMessage> all_;
  Told told_;
  TeamsOfFiles teams_;
  int worst_ = kExitSuccess, written_ = kExitSuccess;
};

int check(const CheckOptions& options) {
  keep_stdout_for_results();
  if (!options.fix) return Checking(options).run();
  if (std::ranges::count(options.trees, "-") != 0) {
    print_error("--fix changes files, and stdin is none",
                "--format json has the edits of each message");
    return kExitUsage;
  }
  const int mended = mend_files(options);
  return first_failure(mended, Checking(options).run());
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
  app.add_flag("--fix", options->fix,
               "First change the files where a message has a mend that is certain");
  auto* const cuts = app.add_flag(
      "--checkpoint", options->cuts,
      "Also list which leaves of a run that is kept (`run --checkpoint`) continue after "
      "a cut, and which start again");
  app.add_option("--format", options->format,
                 "text, or on stdout: json (an array of messages) or github (annotations of a "
                 "workflow)")
      ->check(one_of({"text", "json", "github"},
                     {"sarif", "github annotates the files in a workflow, and json is for others"}))
      ->excludes(cuts)
      ->capture_default_str();
  add_load_options(app, options->load);
  add_mock_option(app, options->load);
  add_program_option(app, options->load.plugins);
  return [options] { return check(*options); };
}

}  // namespace

extern const Command kCheckCommand{
    "check", "Check tree files and report errors and warnings, without running them",
    "Messages go to stderr as file:line:column; in another format they go to stdout. In json, "
    "each\n"
    "has edits that mend it, the best first: patches of the file, in bytes.\n"
    "Exit code: 0 no errors, 3 invalid tree, or a warning with --strict, 4 plugin refused,\n"
    "2 usage, 6 a plugin crashed or hung.\n"
    "\n"
    "Examples:\n"
    "  lockstep check trees\n"
    "  lockstep check --fix tree.xml\n"
    "  lockstep check --checkpoint mission.xml\n"
    "  lockstep check team.xml truck.xml --together\n"
    "  lockstep check --strict --format github trees/*.xml",
    define_check};

}  // namespace lockstep::host
