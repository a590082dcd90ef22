#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <set>

#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "base/terminal/terminal.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/load_options.h"
#include "cli/tools/diff/git_files.h"
#include "describe/tree_diff.h"
#include "language/document/file.h"
#include "run/loading/project_file.h"

namespace lockstep::host {
namespace {

struct DiffCommandOptions {
  LoadCommandOptions load;
  std::vector<std::string> files;
  std::string format = "text";
  bool for_git = false;
};

// One of the two: a file, or the file of a revision.
struct Given {
  std::string path;
  std::optional<std::string> revision = {};
  std::string text_file = {};  // has the text in place of the path; "": the path has it
  std::string shown = {};      // in place of the path; "": none
};

// "git:REV" or "git:REV:PATH"; everything else is a path.
Given parse(const std::string& word) {
  constexpr std::string_view kGit = "git:";
  if (!word.starts_with(kGit)) return {word};
  const auto colon = word.find(':', kGit.size());
  if (colon == std::string::npos) return {"", word.substr(kGit.size())};
  return {word.substr(colon + 1), word.substr(kGit.size(), colon - kGit.size())};
}

// A file of one of the sides, with all of its trees that are compared.
class Side {
 public:
  explicit Side(Given given) : given_(std::move(given)) {}

  // The exit code; with a message unless it is kExitSuccess.
  int open() {
    if (!given_.text_file.empty()) {
      auto text = read_file(given_.text_file, Document::kMaxBytes);
      if (!text) {
        print_error(fmt::format("'{}' cannot be read: {}", given_.text_file, text.error().message));
        return kExitInvalidTree;
      }
      text_ = std::move(*text);
    }
    if (!given_.revision) return kExitSuccess;
    auto files = GitFiles::read(*given_.revision, given_.path);
    if (!files) return refuse(files.error());
    files_.emplace(std::move(*files));
    return kExitSuccess;
  }

  tl::expected<Loaded, LoadFailure> load(LoadCommandOptions options,
                                         const std::shared_ptr<PluginSet>& plugins) const {
    Diagnostics diagnostics;
    options.text = text_;
    auto loaded = load_given(file(), options, diagnostics, plugins);
    if (files_) diagnostics = files_->as_named(diagnostics);
    print_diagnostics(diagnostics, Severity::Error);
    return loaded;
  }

  // All trees, after load(). The exit code; with a message unless it is kExitSuccess.
  int load_trees(LoadCommandOptions options, const std::shared_ptr<PluginSet>& plugins) {
    options.text = text_;
    auto loaded = load_trees_given(file(), options, diagnostics_, plugins);
    if (!loaded) return tell(loaded.error());
    trees_ = std::move(*loaded);
    return kExitSuccess;
  }

  // After load_trees(), those in the file itself.
  std::set<std::string> tree_ids() const {
    std::set<std::string> ids;
    const Document& document = *trees_.project->documents.front();
    const auto elements = document.elements();
    for (const std::uint32_t tree : children_in(elements, 0)) {
      const Attribute* id = document.find_attribute(tree, "ID");
      if (elements[tree].tag == "BehaviorTree" && id != nullptr) ids.emplace(id->value);
    }
    return ids;
  }

  std::string name() const {
    if (!given_.shown.empty()) return given_.shown;
    return files_ ? files_->name() : given_.path;
  }

  // After load_trees(): calls use(side) for one of them. An exit code, as above.
  template <class Use>
  int with_tree(const std::string& id, Use use) {
    const bool is_correct = trees_.trees->use(
        id, [&](const Definition& definition) { use(side(definition, *trees_.project)); });
    return is_correct ? kExitSuccess : tell(LoadFailure::Invalid);
  }

  TreeSide side(const Loaded& loaded) const { return side(loaded.definition, *loaded.project); }

 private:
  TreeSide side(const Definition& definition, const Project& of) const {
    return {name(), &definition, [this, project = &of](Place place) {
              SourceLocation location = project->sources.locate(place);
              if (files_) location.file = files_->as_named(std::move(location.file));
              if (!given_.shown.empty() && location.file == given_.path) {
                location.file = given_.shown;
              }
              return location;
            }};
  }

  int tell(LoadFailure failure) const {
    Diagnostics shown = files_ ? files_->as_named(diagnostics_) : diagnostics_;
    print_diagnostics(shown, Severity::Error);
    return exit_code_of(failure);
  }

  std::string file() const { return files_ ? files_->file() : given_.path; }

  Given given_;
  std::optional<GitFiles> files_;
  std::optional<std::string> text_;
  Diagnostics diagnostics_;
  LoadedTrees trees_;
};

std::string text_of(const TreeDiff& diff, const std::string& format) {
  if (format == "json") return diff_as_json(diff);
  if (format == "svg") return diff_as_svg(diff);
  if (format == "html") return diff_as_page(diff);
  const bool color = wants_color(results_file());
  return format == "tree" ? diff_as_tree(diff, !has_unicode(), color) : diff_as_text(diff, color);
}

// The main trees, or each of the trees of files that have none.
int compare(const DiffCommandOptions& options, Side& a, Side& b) {
  for (Side* it : {&a, &b}) {
    if (const int code = it->open(); code != kExitSuccess) return code;
  }
  LoadCommandOptions load = options.load;
  load.mock = true;  // no leaf runs
  load.may_lack_main = true;
  const auto plugins = std::make_shared<PluginSet>();
  auto new_loaded = b.load(load, plugins);
  auto old_loaded = a.load(load, plugins);
  for (const auto* it : {&old_loaded, &new_loaded}) {
    if (!*it && it->error() != LoadFailure::NothingToRun) return exit_code_of(it->error());
  }
  if (old_loaded && new_loaded) {
    if (old_loaded->definition.rules != new_loaded->definition.rules) {
      print_note("the trees are in two languages, in which many nodes have different names",
                 "`lockstep convert` converts one of them to the language of the other");
    }
    const TreeDiff diff(a.side(*old_loaded), b.side(*new_loaded));
    const int written = write_results(text_of(diff, options.format));
    return first_failure(written, diff.same() ? kExitSuccess : kExitFailure);
  }
  load.is_part = true;
  for (Side* it : {&b, &a}) {
    if (const int code = it->load_trees(load, plugins); code != kExitSuccess) return code;
  }
  const auto of_a = a.tree_ids(), of_b = b.tree_ids();
  if (options.format != "text" && options.format != "json" && options.format != "tree") {
    print_error("the file has no main tree",
                fmt::format("name one of its trees with --tree: {}",
                            joined(std::vector<std::string>(of_b.begin(), of_b.end()), ", ")));
    return kExitUsage;
  }
  std::set<std::string> all = of_a;
  all.insert(of_b.begin(), of_b.end());
  std::string text;
  bool is_same = true;
  for (const std::string& id : all) {
    if (!of_a.contains(id) || !of_b.contains(id)) {
      is_same = false;
      const bool is_new = of_b.contains(id);
      text += tree_as_change(id, is_new ? TreeChangeKind::New : TreeChangeKind::Gone,
                             is_new ? b.name() : a.name(), options.format == "json");
      continue;
    }
    int code_of_old = kExitSuccess;
    const int code = b.with_tree(id, [&](const TreeSide& new_side) {
      code_of_old = a.with_tree(id, [&](const TreeSide& old_side) {
        const TreeDiff diff(old_side, new_side);
        is_same &= diff.same();
        text += text_of(diff, options.format);
      });
    });
    if (const int failed = first_failure(code, code_of_old); failed != kExitSuccess) return failed;
  }
  return first_failure(write_results(text), is_same ? kExitSuccess : kExitFailure);
}

int refuse_files(const std::string& message) {
  print_error(message, "`lockstep diff --help` has examples");
  return kExitUsage;
}

// git gives PATH OLD-FILE OLD-HEX OLD-MODE NEW-FILE NEW-HEX NEW-MODE, and of a renamed file also
// its new path and what has changed. A program that does not exit with 0 ends `git diff`.
int diff_for_git(const DiffCommandOptions& options) {
  const auto& words = options.files;
  if (words.size() == 1) {
    return write_results(fmt::format("{}: not merged\n", printable(words[0])));
  }
  if (words.size() != 7 && words.size() != 9) return refuse_files("git gives 7 or 9 arguments");
  const std::string& path = words.size() == 9 ? words[7] : words[0];
  const std::string old_name = "a/" + words[0], new_name = "b/" + path;
  int code =
      write_results(fmt::format("lockstep diff {} {}\n", printable(old_name), printable(new_name)));
  if (code != kExitSuccess) return code;
  if (words[1] == "/dev/null" || words[4] == "/dev/null") {
    return write_results(words[1] == "/dev/null" ? "the file is new\n" : "the file is gone\n");
  }
  Side a({words[0], {}, words[1], old_name}), b({path, {}, words[4], new_name});
  code = compare(options, a, b);
  if (code == kExitSuccess) return write_results("no change of the trees\n");
  if (code == kExitFailure) return kExitSuccess;
  return write_results("not compared; `git diff --no-ext-diff` shows the texts\n");
}

int diff(const DiffCommandOptions& options) {
  keep_stdout_for_results();
  if (options.for_git) return diff_for_git(options);
  auto words = options.files;
  if (words.size() > 2) return refuse_files("two trees are compared, not more");
  // What is not given: the revision HEAD, and the main file of the project.
  std::vector<Given> given;
  for (const std::string& it : words) given.push_back(parse(it));
  if (given.empty()) given.push_back({"", "HEAD"});
  if (given.size() == 1 && given[0].revision) {
    given.push_back({given[0].path});
  } else if (given.size() == 1) {
    given.insert(given.begin(), Given{given[0].path, "HEAD"});
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (given[i].path.empty()) given[i].path = given[1 - i].path;
  }
  if (given[0].path.empty()) {
    Diagnostics diagnostics;
    given[0].path = given[1].path = main_file_here(diagnostics);
    print_diagnostics(diagnostics, Severity::Error);
    if (given[0].path.empty()) return refuse_files("no tree file is given");
  }
  if (given[0].path == "-" && given[1].path == "-") {
    return refuse_files("only one of the two files can be stdin");
  }
  Side a(given[0]), b(given[1]);
  return compare(options, a, b);
}

std::function<int()> define_diff(CLI::App& app) {
  const auto options = std::make_shared<DiffCommandOptions>();
  app.add_option("trees", options->files,
                 "Two tree files, the old one first. git:REV is the other file in that revision, "
                 "and git:REV:PATH another one; - is stdin (default: git:HEAD, and the main file "
                 "of the project)")
      ->type_name("TREE.xml|git:REV");
  app.add_option("--format", options->format,
                 "text: a line for each change; tree: both trees in one, with a sign before each "
                 "line; json; svg: a drawing of both trees in one; or html: a page with the "
                 "drawing and the lines")
      ->check(one_of({"text", "tree", "json", "svg", "html"}))
      ->capture_default_str();
  app.add_flag_callback(
      "--json", [options] { options->format = "json"; }, "As --format json");
  app.add_flag("--git", options->for_git,
               "Take the arguments that git gives to an external diff program, and exit with 0");
  add_load_options(app, options->load);
  add_program_option(app, options->load.plugins);
  return [options] { return diff(*options); };
}

}  // namespace

extern const Command kDiffCommand{
    "diff", "Compare two trees by their meaning: what is new, gone, moved, renamed or changed",
    "Includes and arguments are replaced first. Layout, comments, the order of attributes and\n"
    "defaults that are written do not count. Nodes that no plugin has are accepted.\n"
    "Exit code: 0 the same, 1 they differ, 2 usage, or git has no such file, 3 a tree is invalid\n"
    "or cannot be read, 4 plugin refused, 6 a plugin crashed or hung.\n"
    "\n"
    "Examples:\n"
    "  lockstep diff old.xml new.xml\n"
    "  lockstep diff git:HEAD~1 tree.xml\n"
    "  lockstep diff git:main tree.xml --format svg > change.svg\n"
    "  git config diff.lockstep.command 'lockstep diff --git'",
    define_diff};

}  // namespace lockstep::host
