#include "language/document/project.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/core/audience.h"
#include "base/core/identifier.h"
#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "language/document/arguments.h"
#include "language/document/file.h"
#include "language/document/library.h"
#include "language/document/reporter.h"
#include "language/document/vocabulary.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxIncludeDepth = 32;
constexpr std::string_view kIncludeAttributes[] = {"path", "as"};
constexpr std::size_t kMostDocuments = 10'000;  // a file counts each time that it has a name
constexpr std::size_t kLongestPrefix = 256;

bool is_root(const Document& document) {
  return document.elements()[0].tag == "root";
}

class Loader {
 public:
  Loader(const Arguments& given, const RosPackages& packages, const UnsavedTexts& unsaved,
         const Library* library, Diagnostics& diagnostics)
      : report_(project_->sources, diagnostics),
        arguments_(given, report_),
        packages_(packages),
        unsaved_(unsaved),
        library_(library),
        diagnostics_(diagnostics) {}

  std::unique_ptr<Project> load(const std::string& path, std::string text) {
    bytes_ = text.size();
    if (!add({path, file_identity(path)}, std::move(text))) return nullptr;
    arguments_.check_given();
    project_->given = project_->documents.size();
    if (library_ != nullptr) add_models();
    for (std::size_t i = 0; i < project_->documents.size(); ++i) {
      substitute(*project_->documents[i]);
      if (library_ != nullptr) add_missing(i);
    }
    for (std::uint32_t i = 0; i < project_->documents.size(); ++i) qualify(i);
    project_->arguments = arguments_.take();
    return std::move(project_);
  }

 private:
  struct Reading {
    std::string path;
    std::string identity;
    std::string prefix = {};               // Project::prefixes
    std::uint32_t document = kUnreadable;  // in Project::documents
  };
  static constexpr std::uint32_t kUnreadable = 0xffffffff;

  bool add(const Reading& file, std::string text);
  // Reads it and adds it. What is wrong; "": nothing.
  std::string add(const Reading& file);
  void add_models();
  // The files of the library with trees that this document uses and no file has.
  void add_missing(std::size_t document);
  void add_missing(std::string_view tree, Place place, std::size_t document);
  void note_trees();
  void include(Document& document, std::uint32_t element);
  bool check_include(const Document& document, std::uint32_t element);
  std::optional<std::string> prefix_of(const Document& document, std::uint32_t include) const;
  void name(const Document& document, std::uint32_t include, const Reading& file);
  void qualify(std::uint32_t document);
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
  const Library* const library_;
  Diagnostics& diagnostics_;
  std::vector<Reading> open_;  // the chain of includes that is being read
  std::map<std::pair<std::string, std::string>, std::uint32_t> read_;  // by identity and prefix
  std::size_t bytes_ = 0;                                              // of all files
  std::set<std::string> trees_;                                        // their names in the project
  std::size_t noted_ = 0;  // documents whose trees are in it
};

template <class Visit>
void Loader::for_each_child(Document& document, std::string_view tag, Visit visit) {
  const auto elements = document.elements();
  for (const std::uint32_t child : children_in(elements, 0))
    if (elements[child].tag == tag) visit(child);
}

bool Loader::add(const Reading& file, std::string text) {
  const auto [read, is_new] = read_.emplace(std::pair(file.identity, file.prefix), kUnreadable);
  auto parsed = Document::parse(file.path, std::move(text), diagnostics_, project_->sources.next());
  if (!parsed) return false;
  read->second = static_cast<std::uint32_t>(project_->documents.size());
  project_->sources.add(parsed->source());
  project_->includes.emplace_back();
  project_->prefixes.push_back(file.prefix);
  auto& document = *project_->documents.emplace_back(std::move(parsed));
  if (project_->documents.size() == 1) {
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
  const auto prefix = prefix_of(document, element);
  if (!prefix) return;
  const Reading next{path, file_identity(path), *prefix};
  if (const auto chain = cycle(next); !chain.empty()) return fail("include cycle: " + chain);
  if (const auto known = read_.find({next.identity, next.prefix}); known != read_.end()) {
    includes(open_.back().document, known->second);
    return name(document, element, next);
  }
  if (project_->documents.size() == kMostDocuments)
    return fail(fmt::format("more than {} files", kMostDocuments));
  if (open_.size() > kMaxIncludeDepth)
    return fail(fmt::format("includes are nested deeper than {} levels", kMaxIncludeDepth));
  if (auto wrong = add(next); !wrong.empty()) return fail(std::move(wrong));
  includes(open_.back().document, read_.at({next.identity, next.prefix}));
  name(document, element, next);
}

std::string Loader::add(const Reading& file) {
  const auto unsaved = unsaved_.find(file.identity);
  auto text = unsaved != unsaved_.end() ? Result<std::string>(*unsaved->second)
                                        : read_file(file.path, Document::kMaxBytes);
  if (!text) return fmt::format("cannot read '{}': {}", brief(file.path), text.error().message);
  bytes_ += text->size();
  if (bytes_ > Document::kMaxBytes)
    return fmt::format("with '{}' the files are larger than {} MiB together", file.path,
                       Document::kMaxBytes >> 20u);
  add(file, std::move(*text));
  return {};
}

void Loader::add_models() {
  for (const std::string& path : library_->models(*project_->rules)) {
    const Reading file{path, file_identity(path)};
    if (read_.contains({file.identity, file.prefix})) continue;
    if (const auto wrong = add(file); !wrong.empty()) report_.nowhere("bad-include"_code, wrong);
    const auto added = read_.find({file.identity, file.prefix});
    const bool is_there = added != read_.end() && added->second != kUnreadable;
    if (is_there) project_->includes[0].push_back(added->second);
  }
}

void Loader::note_trees() {
  for (; noted_ < project_->documents.size(); ++noted_) {
    Document& document = *project_->documents[noted_];
    for_each_child(document, "BehaviorTree", [&](std::uint32_t tree) {
      const Attribute* id = document.find_attribute(tree, "ID");
      if (id != nullptr) trees_.insert(project_->prefixes[noted_] + std::string(id->value));
    });
  }
  for (const Project::NamedFile& file : project_->named) trees_.insert(file.name);
}

void Loader::add_missing(std::size_t index) {
  note_trees();
  const Document& document = *project_->documents[index];
  if (!is_root(document)) return;
  const auto look_for = [&](std::uint32_t element, std::string_view name) {
    const Attribute* id = document.find_attribute(element, name);
    if (id != nullptr && !id->value.empty()) add_missing(id->value, id->place, index);
  };
  if (index == 0) look_for(0, "main_tree_to_execute");
  const auto elements = document.elements();
  for (const std::uint32_t tree : children_in(elements, 0)) {
    if (elements[tree].tag != "BehaviorTree") continue;
    for (std::uint32_t i = tree + 1; i < elements[tree].end; ++i) {
      if (elements[i].tag == "SubTree" || elements[i].tag == "SubTreePlus") look_for(i, "ID");
    }
  }
}

void Loader::add_missing(std::string_view tree, Place place, std::size_t document) {
  const std::string prefix = project_->prefixes[document];
  if (!trees_.insert(prefix + std::string(tree)).second) return;
  const auto files = library_->files_with(tree, *project_->rules);
  if (files.empty()) {
    if (project_->library_trees.empty())
      project_->library_trees = library_->trees(*project_->rules);
    return;
  }
  if (files.size() > 1) {
    const std::vector<std::string_view> names(files.begin(), files.end());
    report_.at_value("duplicate-tree"_code, place,
                     fmt::format("{} files of the project have the tree '{}': {}", files.size(),
                                 brief(tree), listed(names)),
                     "include the one that is meant");
  }
  const Reading file{files[0], file_identity(files[0]), prefix};
  if (read_.contains({file.identity, file.prefix})) return;
  if (project_->documents.size() == kMostDocuments) {
    return report_.at_value("too-large"_code, place,
                            fmt::format("more than {} files", kMostDocuments));
  }
  if (auto wrong = add(file); !wrong.empty())
    return report_.at_value("bad-include"_code, place, std::move(wrong));
  const std::uint32_t added = read_.at({file.identity, file.prefix});
  if (added != kUnreadable) {
    project_->includes[document].push_back(added);
    note_trees();
  }
}

// What stands before the names of the included file; nothing after an error.
std::optional<std::string> Loader::prefix_of(const Document& document,
                                             std::uint32_t include) const {
  const std::string& around = open_.back().prefix;
  const Attribute* as = document.find_attribute(include, "as");
  if (as == nullptr) return around;
  std::string prefix = fmt::format("{}{}.", around, as->value);
  if (!is_identifier(as->value)) {
    report_.at_value("bad-name"_code, as->place,
                     fmt::format("'{}' is not a name for a file", brief(as->value)),
                     fmt::format("such a name is {}", kIdentifierRule));
  } else if (prefix.size() > kLongestPrefix) {
    report_.at_value(
        "too-large"_code, as->place, "the names of these files are too long",
        fmt::format("'{}' has more than {} characters", brief(prefix), kLongestPrefix));
  } else {
    return prefix;
  }
  return std::nullopt;
}

void Loader::name(const Document& document, std::uint32_t include, const Reading& file) {
  const Attribute* as = document.find_attribute(include, "as");
  const std::uint32_t named = read_.at({file.identity, file.prefix});
  if (as == nullptr || named == kUnreadable) return;
  const std::string name = file.prefix.substr(0, file.prefix.size() - 1);
  const auto first = std::ranges::find(project_->named, name, &Project::NamedFile::name);
  if (first == project_->named.end()) {
    project_->named.push_back({name, as->place, named});
  } else if (first->document != named) {
    report_.at_value(
        "duplicate-name"_code, as->place,
        fmt::format("another file has the name '{}'", brief(name)),
        fmt::format("it is included at {}", to_text(project_->sources.locate(first->place))));
  }
}

// Gives the trees of a file with a prefix, and what names them, their names in the project.
void Loader::qualify(std::uint32_t index) {
  const std::string& prefix = project_->prefixes[index];
  if (prefix.empty()) return;
  Document& document = *project_->documents[index];
  const auto put_before = [&](std::uint32_t element, std::string_view name) {
    const Attribute* it = document.find_attribute(element, name);
    if (it == nullptr || it->value.empty()) return;
    document.set_value(*it, prefix + std::string(it->value));
  };
  const auto elements = document.elements();
  put_before(0, "main_tree_to_execute");
  for (std::uint32_t i = 1; i < elements.size(); ++i) {
    constexpr std::string_view kTags[] = {"BehaviorTree", "SubTree", "SubTreePlus"};
    if (std::ranges::find(kTags, elements[i].tag) != std::end(kTags)) put_before(i, "ID");
  }
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
                                      const RosPackages& packages, const Library* library) {
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
  return load_project_text(name, std::move(*text), arguments, diagnostics, packages, {}, library);
}

std::unique_ptr<Project> load_project_text(const std::string& path, std::string text,
                                           const Arguments& arguments, Diagnostics& diagnostics,
                                           const RosPackages& packages, const UnsavedTexts& unsaved,
                                           const Library* library) {
  return Loader(arguments, packages, unsaved, library, diagnostics).load(path, std::move(text));
}

Arguments values_of(const std::vector<DeclaredArgument>& arguments) {
  Arguments values;
  for (const DeclaredArgument& it : arguments) values[it.name] = it.value;
  return values;
}

}  // namespace lockstep::host
