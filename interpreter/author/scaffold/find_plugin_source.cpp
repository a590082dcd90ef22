#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "author/scaffold/code_mask.h"
#include "author/scaffold/plugin_source.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxSourceBytes = std::size_t{4} << 20U;
constexpr int kMaxDepth = 4;
constexpr int kMostEntries = 10'000;

// The language of a source of a plugin; else null.
const SourceLanguage* language_of(const fs::path& path, const std::string& text) {
  for (const SourceLanguage& language : source_languages()) {
    if (path.extension() != language.extension) continue;
    if (code_mask(language, text).find(language.mark) != std::string::npos) return &language;
  }
  return nullptr;
}

// With a language, if it is the source of a plugin.
PluginSource read_source(const fs::path& path) {
  auto text = read_file(path.string(), kMaxSourceBytes);
  if (!text) return {path, nullptr, {}};
  const SourceLanguage* const language = language_of(path, *text);
  return {path.lexically_normal(), language, std::move(*text)};
}

// lib/lockstep, lib/x86_64-linux-gnu/lockstep or share/lockstep of a prefix below the project.
bool is_installed(const fs::path& folder) {
  if (folder.filename() != "lockstep") return false;
  const fs::path above = folder.parent_path();
  const auto is_lib = [](const fs::path& name) { return name == "lib" || name == "lib64"; };
  return above.filename() == "share" || is_lib(above.filename()) ||
         is_lib(above.parent_path().filename());
}

// Folders of builds and hidden ones have sources that are not the author's, and installed plugins
// are copies of his.
bool is_left_out(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename();
  return name.starts_with('.') || name.starts_with("build") || name == "node_modules" ||
         is_installed(entry.path());
}

std::vector<PluginSource> sources_below(const fs::path& folder) {
  std::vector<PluginSource> found;
  std::error_code error;
  int left = kMostEntries;  // of a home directory, say
  for (fs::recursive_directory_iterator
           it(folder, fs::directory_options::skip_permission_denied, error),
       end;
       !error && it != end && left-- > 0; it.increment(error)) {
    if (it->is_directory(error) && (is_left_out(*it) || it.depth() >= kMaxDepth)) {
      it.disable_recursion_pending();
    }
    if (!it->is_regular_file(error)) continue;
    PluginSource source = read_source(it->path());
    if (source.language != nullptr) found.push_back(std::move(source));
  }
  std::ranges::sort(found, {}, &PluginSource::path);
  return found;
}

}  // namespace

Result<PluginSource> find_plugin_source(const fs::path& where) {
  std::error_code error;
  if (!fs::exists(where, error)) {
    return problem(fmt::format("there is no '{}'", where.string()),
                   "name a source, or a folder, with --in");
  }
  if (!fs::is_directory(where, error)) {
    PluginSource source = read_source(where);
    if (source.language != nullptr) return source;
    return problem(fmt::format("'{}' is not the source of a plugin", where.string()),
                   "lockstep new plugin NAME makes one");
  }
  std::vector<PluginSource> found = sources_below(where);
  if (found.empty()) {
    return problem(fmt::format("there is not the source of a plugin in '{}'", where.string()),
                   "lockstep new plugin NAME makes one; --in FILE names one elsewhere");
  }
  if (found.size() == 1) return std::move(found.front());
  std::string names;
  for (const PluginSource& source : found) {
    names += fmt::format("{}'--in {}'", names.empty() ? "" : ", ", source.path.string());
  }
  return problem(fmt::format("there are {} plugins here", found.size()), "name one: " + names);
}

}  // namespace lockstep::host
