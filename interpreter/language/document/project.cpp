#include "language/document/project.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/core/audience.h"
#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "language/document/arguments.h"
#include "language/document/file.h"
#include "language/document/reporter.h"
#include "language/document/vocabulary.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxIncludeDepth = 32;
constexpr std::string_view kIncludeAttributes[] = {"path"};

bool is_root(const Document& document) {
  return document.elements()[0].tag == "root";
}

class Loader {
 public:
  Loader(const Arguments& given, const RosPackages& packages, const UnsavedTexts& unsaved,
         Diagnostics& diagnostics)
      : report_(project_->sources, diagnostics),
        arguments_(given, report_),
        packages_(packages),
        unsaved_(unsaved),
        diagnostics_(diagnostics) {}

  std::unique_ptr<Project> load(const std::string& path, std::string text) {
    bytes_ = text.size();
    if (!add({path, file_identity(path)}, std::move(text))) return nullptr;
    arguments_.check_given();
    for (const auto& document : project_->documents) substitute(*document);
    project_->arguments = arguments_.take();
    return std::move(project_);
  }

 private:
  struct Reading {
    std::string path;
    std::string identity;
    std::uint32_t document = kUnreadable;  // in Project::documents
  };
  static constexpr std::uint32_t kUnreadable = 0xffffffff;

  bool add(const Reading& file, std::string text);
  void include(Document& document, std::uint32_t element);
  bool check_include(const Document& document, std::uint32_t element);
  std::optional<fs::path> directory_of(const Document& document, std::uint32_t include,
                                       const fs::path& written) const;
  void includes(std::uint32_t includer, std::uint32_t included) {
    if (included != kUnreadable) project_->includes[includer].push_back(included);
  }
  // The chain of files that `next` would close, or "".
  std::string cycle(const Reading& next) const;
  void substitute(Document& document);
  template <class Visit>
  void for_each_child(Document& document, std::string_view tag, Visit visit);

  std::unique_ptr<Project> project_ = std::make_unique<Project>();
  Reporter report_;
  ArgumentTable arguments_;
  const RosPackages& packages_;
  const UnsavedTexts& unsaved_;
  Diagnostics& diagnostics_;
  std::vector<Reading> open_;                  // the chain of includes that is being read
  std::map<std::string, std::uint32_t> read_;  // by identity: its document
  std::size_t bytes_ = 0;                      // of all files
};

template <class Visit>
void Loader::for_each_child(Document& document, std::string_view tag, Visit visit) {
  const auto elements = document.elements();
  for (const std::uint32_t child : children_in(elements, 0))
    if (elements[child].tag == tag) visit(child);
}

bool Loader::add(const Reading& file, std::string text) {
  const auto [read, is_new] = read_.emplace(file.identity, kUnreadable);
  auto parsed = Document::parse(file.path, std::move(text), diagnostics_, project_->sources.next());
  if (!parsed) return false;
  read->second = static_cast<std::uint32_t>(project_->documents.size());
  project_->sources.add(parsed->source());
  project_->includes.emplace_back();
  auto& document = *project_->documents.emplace_back(std::move(parsed));
  if (open_.empty()) {
    project_->rules = &document.rules();
    arguments_.set_rules(document.rules());
  }
  if (!is_root(document)) {
    const Element& first = document.elements()[0];
    report_.at(
        "wrong-root"_code, first.place,
        fmt::format("the first element must be 'root', not '{}'", brief(first.tag)),
        first.tag == "scenarios" ? "it has scenarios of a tree: `lockstep test` reads it" : "");
    return true;
  }
  open_.push_back(file);
  open_.back().document = read->second;
  // All arguments of a file before its includes: an included file sees those of its includer.
  for_each_child(document, "arg", [&](auto i) { arguments_.declare(document, i); });
  for_each_child(document, "include", [&](auto i) { include(document, i); });
  open_.pop_back();
  return true;
}

void Loader::include(Document& document, std::uint32_t element) {
  if (!check_include(document, element)) return;
  if (!arguments_.substitute(document, element)) return;
  const Attribute& attribute = *document.find_attribute(element, "path");
  const fs::path written(attribute.value);
  const auto from = directory_of(document, element, written);
  if (!from) return;
  const auto path = (*from / written).lexically_normal().string();
  const auto fail = [&](std::string message) {
    report_.at_value("bad-include"_code, attribute.place, std::move(message));
  };
  const Reading next{path, file_identity(path)};
  if (const auto chain = cycle(next); !chain.empty()) return fail("include cycle: " + chain);
  if (const auto known = read_.find(next.identity); known != read_.end()) {
    includes(open_.back().document, known->second);
    return;
  }
  if (open_.size() > kMaxIncludeDepth)
    return fail(fmt::format("includes are nested deeper than {} levels", kMaxIncludeDepth));
  const auto unsaved = unsaved_.find(next.identity);
  auto text = unsaved != unsaved_.end() ? Result<std::string>(*unsaved->second)
                                        : read_file(path, Document::kMaxBytes);
  if (!text) return fail(fmt::format("cannot read '{}': {}", brief(path), text.error().message));
  bytes_ += text->size();
  if (bytes_ > Document::kMaxBytes)
    return fail(fmt::format("with '{}' the files are larger than {} MiB together", path,
                            Document::kMaxBytes >> 20u));
  add(next, std::move(*text));
  includes(open_.back().document, read_.at(next.identity));
}

bool Loader::check_include(const Document& document, std::uint32_t element) {
  if (!project_->rules->lenient_includes) {
    return check_vocabulary(document, element, kIncludeAttributes, 1, report_);
  }
  if (document.find_attribute(element, "path") != nullptr) return true;
  report_.at("missing-attribute"_code, document.elements()[element].place,
             "'include' needs the attribute 'path'");
  return false;
}

// To which the path of an include is relative; nothing after an error.
std::optional<fs::path> Loader::directory_of(const Document& document, std::uint32_t include,
                                             const fs::path& written) const {
  const Attribute* package = document.find_attribute(include, "ros_pkg");
  const bool in_package = project_->rules->lenient_includes && package != nullptr;
  if (!in_package || written.is_absolute())
    return fs::path(document.source()->path()).parent_path();
  if (auto share = packages_.find(package->value)) return share;
  report_.at_value("unknown-package"_code, package->place,
                   fmt::format("the ROS package '{}' is not found", brief(package->value)),
                   worded(fmt::format("it is searched in AMENT_PREFIX_PATH; or give its share "
                                      "directory with --ros-package {}=DIR",
                                      brief(package->value)),
                          std::string("it is searched in AMENT_PREFIX_PATH")));
  return std::nullopt;
}

std::string Loader::cycle(const Reading& next) const {
  const auto first = std::find_if(open_.begin(), open_.end(), [&](const Reading& reading) {
    return reading.identity == next.identity;
  });
  if (first == open_.end()) return {};
  std::vector<std::string_view> circle;
  for (auto reading = first; reading != open_.end(); ++reading) circle.push_back(reading->path);
  circle.push_back(next.path);
  return chained(circle);
}

// A character reference may stand for a part of "${", so it counts too.
bool may_use_arguments(const Document& document) {
  const auto has = [&](std::string_view part) {
    return document.source()->text().find(part) != std::string_view::npos;
  };
  return has("${") || has("&#");
}

void Loader::substitute(Document& document) {
  if (!may_use_arguments(document)) return;
  const auto elements = document.elements();
  const auto is_read = [&](std::uint32_t i) {
    return is_root(document) && (elements[i].tag == "arg" || elements[i].tag == "include");
  };
  arguments_.substitute(document, 0);
  for (const std::uint32_t child : children_in(elements, 0)) {
    // Substituted when it was read; the text of an argument is not looked into again.
    if (is_read(child) || elements[child].tag == "scenario") continue;  // which has its own
    for (auto i = child; i < elements[child].end; ++i) arguments_.substitute(document, i);
  }
}

}  // namespace

std::string file_identity(const std::string& path) {
  std::error_code error;
  const auto canonical = fs::canonical(path, error);
  return error ? fs::path(path).lexically_normal().string() : canonical.string();
}

std::unique_ptr<Project> load_project(const std::string& path, const Arguments& arguments,
                                      Diagnostics& diagnostics, MainFile main,
                                      const RosPackages& packages) {
  const bool is_stdin = main == MainFile::MayBePipe && path == "-";
  const auto kinds = main == MainFile::MayBePipe ? FileKinds::RegularOrPipe : FileKinds::Regular;
  auto text =
      is_stdin ? read_stdin(Document::kMaxBytes) : read_file(path, Document::kMaxBytes, kinds);
  const std::string name = is_stdin ? "stdin" : path;
  if (!text) {
    const std::string verdict = name.empty() ? "'' cannot be read: " : "cannot be read: ";
    diagnostics.error("unreadable-file"_code, {name}, verdict + text.error().message);
    return nullptr;
  }
  return load_project_text(name, std::move(*text), arguments, diagnostics, packages);
}

std::unique_ptr<Project> load_project_text(const std::string& path, std::string text,
                                           const Arguments& arguments, Diagnostics& diagnostics,
                                           const RosPackages& packages,
                                           const UnsavedTexts& unsaved) {
  return Loader(arguments, packages, unsaved, diagnostics).load(path, std::move(text));
}

Arguments values_of(const std::vector<DeclaredArgument>& arguments) {
  Arguments values;
  for (const DeclaredArgument& it : arguments) values[it.name] = it.value;
  return values;
}

}  // namespace lockstep::host
