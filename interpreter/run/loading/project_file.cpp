#include "run/loading/project_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/core/pre_order.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "language/document/file.h"
#include "language/document/library.h"
#include "language/document/vocabulary.h"
#include "run/loading/plugin_directories.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolder[] = {"folder"};
constexpr std::string_view kFile[] = {"file"};

// Relative as the tree is; "": there is none.
std::string project_file_of(const std::string& tree) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  if (error) return {};
  const bool is_relative = fs::path(tree).is_relative();
  for (fs::path folder = (here / tree).lexically_normal().parent_path();;
       folder = folder.parent_path()) {
    const fs::path file = folder / kProjectFile;
    if (fs::is_regular_file(file, error)) {
      return is_relative ? file.lexically_proximate(here).string() : file.string();
    }
    if (folder == folder.parent_path()) return {};
  }
}

bool may_name_plugins(const std::string& file) {
  struct stat it {};
  if (::stat(file.c_str(), &it) != 0) return false;
  return (it.st_uid == ::geteuid() || it.st_uid == 0) && (it.st_mode & S_IWOTH) == 0;
}

class ProjectFileReader {
 public:
  ProjectFileReader(std::string path, Library& library, PluginOptions& plugins,
                    Diagnostics& diagnostics)
      : path_(std::move(path)),
        library_(library),
        plugins_(plugins),
        diagnostics_(diagnostics),
        report_(sources_, diagnostics) {}

  void read() {
    auto text = read_file(path_, Document::kMaxBytes);
    if (!text)
      return diagnostics_.error("unreadable-file"_code, {path_},
                                "cannot be read: " + text.error().message);
    const auto document = Document::parse(path_, std::move(*text), diagnostics_);
    if (document == nullptr) return;
    sources_.add(document->source());
    const auto elements = document->elements();
    if (elements[0].tag != "project") {
      return report_.at(
          "wrong-root"_code, elements[0].place,
          fmt::format("the first element must be 'project', not '{}'", brief(elements[0].tag)));
    }
    const Attribute* version = document->find_attribute(0, "lockstep");
    if (version == nullptr || version->value != "1") {
      const Place place = version == nullptr ? elements[0].place : version->place;
      return report_.at("unknown-version"_code, place,
                        version == nullptr
                            ? std::string("the project file names no version")
                            : fmt::format("unknown version '{}'", brief(version->value)),
                        "this lockstep knows version 1: <project lockstep=\"1\">");
    }
    for (const std::uint32_t child : children_in(elements, 0)) read(*document, child);
  }
  const std::string& main_file() const { return main_; }

 private:
  void read(const Document& document, std::uint32_t element) {
    constexpr std::string_view kTags[] = {"main", "trees", "plugins", "models"};
    const Element& it = document.elements()[element];
    if (std::ranges::find(kTags, it.tag) == std::end(kTags)) {
      return report_.at("unknown-element"_code, it.place,
                        fmt::format("unknown element '{}' in 'project'", brief(it.tag)),
                        suggest(it.tag, kTags, "elements of 'project'"));
    }
    const bool is_main = it.tag == "main";
    if (is_main && std::exchange(has_main_, true)) {
      return report_.at("duplicate-name"_code, it.place, "a second 'main' in 'project'",
                        "a project has one main tree: delete the others");
    }
    const bool is_file = is_main || it.tag == "models";
    if (!check_vocabulary(document, element, is_file ? kFile : kFolder, 1, report_)) return;
    const Attribute& named = *document.find_attribute(element, is_file ? "file" : "folder");
    const auto below = fs::path(named.value).lexically_normal();
    if (named.value.empty() || below.is_absolute() || *below.begin() == "..") {
      return report_.at_value("bad-value"_code, named.place,
                              fmt::format("'{}' is not below the project file", brief(named.value)),
                              "such a path is relative, and without '..' at its beginning");
    }
    const auto path = (fs::path(path_).parent_path() / below).lexically_normal().string();
    std::error_code unused;
    if (is_file ? !fs::is_regular_file(path, unused) : !fs::is_directory(path, unused)) {
      if (it.tag == "plugins") return;  // nothing is built yet
      return report_.at_value(
          "bad-value"_code, named.place,
          fmt::format("there is no {} '{}'", is_file ? "file" : "folder", brief(path)));
    }
    if (is_main) {
      main_ = path;
    } else if (it.tag == "trees") {
      Diagnostics of_folder;
      library_.add_folder(path, of_folder);
      for (const Diagnostic& problem : of_folder.all())  // `check FOLDER` reports the rest
        if (problem.severity == Severity::Error) diagnostics_.add(problem);
    } else if (is_file) {
      library_.add_models(path);
    } else if (may_name_plugins(path_)) {
      plugins_.directories.push_back(path);
    } else {
      report_.at("untrusted-path"_code, it.place, "the folder of plugins is not searched",
                 "the project file belongs to another user, or others may write it; "
                 "--plugin-path names the folder",
                 Severity::Warning);
    }
  }

  const std::string path_;
  std::string main_;
  bool has_main_ = false;
  Library& library_;
  PluginOptions& plugins_;
  Diagnostics& diagnostics_;
  Sources sources_;
  const Reporter report_;
};

}  // namespace

std::string main_file_here(Diagnostics& diagnostics) {
  const std::string file = is_privileged() ? std::string() : project_file_of("main");
  if (file.empty()) return {};
  Library library;
  PluginOptions plugins;
  ProjectFileReader reader(file, library, plugins, diagnostics);
  reader.read();
  return reader.main_file();
}

LoadOptions with_project_file(const std::string& tree, LoadOptions options,
                              Diagnostics& diagnostics) {
  if (is_privileged() || tree == "-") return options;
  const std::string file = project_file_of(tree);
  if (file.empty()) return options;
  auto library = options.library == nullptr ? std::make_shared<Library>()
                                            : std::make_shared<Library>(*options.library);
  ProjectFileReader(file, *library, options.plugins, diagnostics).read();
  options.library = std::move(library);
  return options;
}

}  // namespace lockstep::host
