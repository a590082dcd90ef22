#include "language/document/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <ranges>

#include "base/core/pre_order.h"
#include "base/core/wording.h"
#include "language/document/document.h"
#include "language/document/file.h"
#include "language/document/language_of.h"
#include "language/document/project.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostEntries = 100'000;  // of a folder and those below it
constexpr std::size_t kMostBytes = std::size_t{256} << 20u;

bool is_hidden(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with('.') && name != "." && name != "..";
}

// Whether it has the root of a tree file, of which no more need be there.
bool is_begun(std::string_view text) {
  const auto root = text.find("<root");
  if (root == std::string_view::npos) return false;
  const std::string_view tag = text.substr(root, text.find('>', root) - root);
  return tag.find("lockstep=") != std::string_view::npos ||
         tag.find("BTCPP_format=") != std::string_view::npos;
}

}  // namespace

bool Library::may_be_tree_file(std::string_view path) {
  return path.ends_with(".xml") && !path.ends_with(".test.xml") && !path.ends_with(".leaves.xml") &&
         !path.ends_with(".project.xml");
}

std::vector<std::string> Library::add_folder(const std::string& folder, Diagnostics& diagnostics) {
  std::vector<std::string> found, files;
  std::error_code error;
  std::size_t entries = 0;
  auto entry = fs::recursive_directory_iterator(
      folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (++entries > kMostEntries) {
      diagnostics.error("too-large"_code, {folder},
                        fmt::format("the folder has more than {} files", kMostEntries),
                        "name the folder of the trees");
      return {};
    }
    std::error_code unused;
    if (is_hidden(entry->path())) {
      if (entry->is_directory(unused)) entry.disable_recursion_pending();
    } else if (entry->is_regular_file(unused) && may_be_tree_file(entry->path().string())) {
      found.push_back(entry->path().lexically_normal().string());
    }
  }
  if (error) {
    diagnostics.error("unreadable-file"_code, {folder},
                      fmt::format("cannot be read: {}", error.message()));
    return {};
  }
  std::ranges::sort(found);
  for (std::string& it : found) {
    const Kind kind = add(it);
    if (kind == Kind::Trees) files.push_back(std::move(it));
    // It may have been one, before a disk was full.
    if (kind == Kind::NoXml) {
      diagnostics.note("unreadable-file"_code, {it}, "is not XML, so it is not checked",
                       "restore it, or remove it");
    }
  }
  if (is_full()) {
    diagnostics.error(
        "too-large"_code, {folder},
        fmt::format("the tree files have more than {} MiB together", kMostBytes >> 20u));
  }
  return files;
}

bool Library::is_full() const {
  return bytes_ > kMostBytes;
}

Library::Kind Library::add(const std::string& path) {
  if (is_full()) return Kind::Others;
  auto text = read_file(path, Document::kMaxBytes);
  if (!text) return Kind::Others;
  const bool is_new = known_.insert(file_identity(path)).second;
  if (is_new) bytes_ += text->size();
  const bool names_trees = is_begun(*text) || text->find("BehaviorTree") != std::string::npos;
  Diagnostics told_later;
  const auto document = Document::parse(path, std::move(*text), told_later);
  if (document == nullptr) return names_trees ? Kind::Trees : Kind::NoXml;
  const auto elements = document->elements();
  if (elements[0].tag != "root") return Kind::Others;
  bool has_content = false;
  for (const std::uint32_t child : children_in(elements, 0)) {
    constexpr std::string_view kContent[] = {"BehaviorTree", "TreeNodesModel", "include"};
    has_content |= std::ranges::find(kContent, elements[child].tag) != std::end(kContent);
    const Attribute* id = document->find_attribute(child, "ID");
    if (!is_new || elements[child].tag != "BehaviorTree" || id == nullptr) continue;
    auto& files = files_with_[&document->rules()][std::string(id->value)];
    if (files.empty() || files.back() != path) files.push_back(path);
  }
  return has_content ? Kind::Trees : Kind::Others;
}

void Library::add_models(const std::string& path) {
  const auto text = read_file(path, Document::kMaxBytes);
  if (text) models_.push_back({path, &language_of(*text)});
}

std::span<const std::string> Library::files_with(std::string_view tree,
                                                 const LanguageRules& rules) const {
  const auto trees = files_with_.find(&rules);
  if (trees == files_with_.end()) return {};
  const auto files = trees->second.find(tree);
  return files == trees->second.end() ? std::span<const std::string>() : files->second;
}

std::vector<std::string> Library::trees(const LanguageRules& rules) const {
  const auto found = files_with_.find(&rules);
  if (found == files_with_.end()) return {};
  const auto ids = std::views::keys(found->second);
  return {ids.begin(), ids.end()};
}

std::vector<std::string> Library::models(const LanguageRules& rules) const {
  std::vector<std::string> paths;
  for (const Models& it : models_) {
    if (it.rules == &rules) paths.push_back(it.path);
  }
  return paths;
}

}  // namespace lockstep::host
