#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "author/edit/unified_diff.h"
#include "author/format/format.h"
#include "base/core/wording.h"
#include "base/system/replace_text.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "language/document/byte_order_mark.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

struct FormatCommandOptions {
  std::vector<std::string> paths;
  bool check = false, diff = false;
  FormatOptions format;
};

// Files of other programs may end in .xml, too.
bool is_ours(const Document& document) {
  constexpr std::string_view kRoots[] = {"root", "scenarios", "leaves"};
  return std::ranges::count(kRoots, document.elements()[0].tag) != 0;
}

class FormatRun {
 public:
  explicit FormatRun(const FormatCommandOptions& options) : options_(options) {}

  int run() {
    for (const std::string& path : options_.paths) {
      if (path == "-") {
        format_stdin();
      } else if (std::error_code error; fs::is_directory(path, error)) {
        format_directory(path);
      } else {
        format_file(path, Named::ByUser);
      }
    }
    print_diagnostics(diagnostics_, Severity::Error);
    if (const int written = write_results(results_); written != kExitSuccess) return written;
    if (code_ == kExitSuccess) tell();
    return first_failure(code_, options_.check && changed_ > 0 ? kExitFailure : kExitSuccess);
  }

 private:
  enum class Named { ByUser, ByDirectory };

  struct Formatted {
    std::unique_ptr<Document> document;
    TextEdit edit;
  };

  void fail(const std::string& name, std::string message, std::string hint = {}) {
    diagnostics_.error("bad-format"_code, {name}, std::move(message), std::move(hint));
    code_ = first_failure(code_, kExitInvalidTree);
  }

  // Nothing after an error, and if it is none of our files.
  std::optional<Formatted> formatted(const std::string& name, const std::string& text,
                                     Named named) {
    Diagnostics found;
    auto document = Document::parse(name, text, found);
    const bool is_foreign = document != nullptr && !is_ours(*document);
    if (named == Named::ByDirectory && is_foreign) return std::nullopt;
    if (named == Named::ByDirectory && document == nullptr && !may_be_ours(text))
      return std::nullopt;
    if (is_foreign) {
      fail(name, fmt::format("its root is '{}'", brief(document->elements()[0].tag)),
           "trees have 'root', scenarios 'scenarios', leaf models 'leaves'");
      return std::nullopt;
    }
    if (document == nullptr || found.has_errors()) {
      for (const Diagnostic& it : found.all()) diagnostics_.add(it);
      code_ = first_failure(code_, kExitInvalidTree);
      return std::nullopt;
    }
    auto edit = format(*document, options_.format);
    if (!edit) {
      fail(name, edit.error().message, edit.error().hint);
      return std::nullopt;
    }
    return Formatted{std::move(document), std::move(*edit)};
  }

  // Whether a text that cannot be read seems to be one of our files.
  static bool may_be_ours(std::string_view text) {
    return text.find("<root") != std::string_view::npos ||
           text.find("<scenarios") != std::string_view::npos ||
           text.find("<leaves") != std::string_view::npos;
  }

  void format_stdin() {
    const auto text = read_stdin(Document::kMaxBytes);
    if (!text) return fail("stdin", "cannot be read: " + text.error().message);
    const auto result = formatted("stdin", *text, Named::ByUser);
    if (!result) return;
    count(*result, "stdin");
    if (options_.check || options_.diff) return;
    results_ += byte_order_mark(*text);
    results_ += result->edit.apply(result->document->source()->text());
  }

  void format_directory(const std::string& directory) {
    std::vector<std::string> files;
    std::error_code error;
    fs::recursive_directory_iterator it(directory, error);
    if (error) return fail(directory, "cannot be read: " + error.message());
    for (; it != fs::recursive_directory_iterator(); it.increment(error)) {
      const fs::path& path = it->path();
      const bool is_hidden = path.filename().string().starts_with('.');
      if (is_hidden && it->is_directory(error)) it.disable_recursion_pending();
      if (is_hidden || path.extension() != ".xml" || !it->is_regular_file(error)) continue;
      files.push_back(path.string());
    }
    if (error) fail(directory, "cannot be read: " + error.message());
    std::ranges::sort(files);
    for (const std::string& path : files) {
      // As the user would write it.
      format_file(path.starts_with("./") && directory == "." ? path.substr(2) : path,
                  Named::ByDirectory);
    }
  }

  void format_file(const std::string& path, Named named) {
    const auto text = read_file(path, Document::kMaxBytes);
    if (!text) return fail(path, "cannot be read: " + text.error().message);
    const auto result = formatted(path, *text, named);
    if (!result) return;
    count(*result, path);
    if (result->edit.empty() || options_.check || options_.diff) return;
    std::string after(byte_order_mark(*text));
    after += result->edit.apply(result->document->source()->text());
    if (const auto done = replace_text(path, *text, after); !done) {
      diagnostics_.error("bad-format"_code, {}, done.error().message, done.error().hint);
      code_ = first_failure(code_, kExitUsage);
    }
  }

  void count(const Formatted& result, const std::string& name) {
    ++(result.edit.empty() ? unchanged_ : changed_);
    if (result.edit.empty()) return;
    if (options_.diff) {
      results_ += unified_diff(name, result.document->source()->text(), result.edit);
    } else if (options_.check) {
      results_ += printable(name) + '\n';
    }
  }

  void tell() const {
    const bool is_to_stdout = std::ranges::count(options_.paths, "-") != 0;
    if (is_to_stdout && !options_.check) return;
    const bool is_written = !options_.check && !options_.diff;
    print_note(
        is_written
            ? fmt::format("{} formatted, {} unchanged", counted(changed_, "file"), unchanged_)
            : fmt::format("{} not formatted, {} formatted", counted(changed_, "file"), unchanged_));
  }

  const FormatCommandOptions& options_;
  Diagnostics diagnostics_;
  std::string results_;
  std::size_t changed_ = 0, unchanged_ = 0;
  int code_ = kExitSuccess;
};

std::function<int()> define_fmt(CLI::App& app) {
  const auto options = std::make_shared<FormatCommandOptions>();
  app.add_option("path", options->paths,
                 "Files and folders (default: this folder); - is stdin, and then stdout gets the "
                 "text")
      ->type_name("FILE|DIR|-");
  app.add_flag(
      "--check", options->check,
      "Write nothing; list the files that are not formatted, and exit with code 1 if there "
      "is one");
  app.add_flag("--diff", options->diff, "Write nothing; print what would change");
  app.add_option("--width", options->format.width,
                 "Attributes beyond this column go into the next line")
      ->type_name("COLUMNS")
      ->transform(whole_number(20, 1000))
      ->capture_default_str();
  app.add_flag("--sort-attributes", options->format.sort_attributes,
               "ID and name first, the others by their names");
  return [options] {
    if (options->paths.empty()) options->paths = {"."};
    return FormatRun(*options).run();
  };
}

}  // namespace

extern const Command kFmtCommand{
    "fmt", "Bring tree files, scenarios and leaf models into the canonical layout",
    "Only whitespace and line ends between tags change: values, comments and quotes stay, and\n"
    "an empty line between elements. The file with an error in it is not touched. Of a folder,\n"
    "all .xml files in it and below whose root is 'root', 'scenarios' or 'leaves'.\n"
    "Exit code: 0 all is well, 1 --check found files, 2 usage, or a file that cannot be written,\n"
    "3 a file cannot be read.\n"
    "\n"
    "Examples:\n"
    "  lockstep fmt tree.xml\n"
    "  lockstep fmt --check --diff trees\n"
    "  generate | lockstep fmt - > tree.xml",
    define_fmt};

}  // namespace lockstep::host
