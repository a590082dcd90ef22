#include "author/server/workspace.h"

#include <algorithm>

#include "author/server/uri.h"

namespace lockstep::host {

const Positions& OpenText::positions() const {
  if (!positions_) positions_.emplace(bytes_);
  return *positions_;
}

const TolerantTree& OpenText::tree() const {
  if (!tree_) tree_ = read_tolerantly(bytes_);
  return *tree_;
}

void OpenFile::change(std::span<const TextChange> changes) {
  std::string bytes = text->bytes();
  for (const TextChange& it : changes) {
    if (it.range) {
      const Positions positions(bytes);
      const std::size_t begin = positions.byte_at(it.range->first);
      const std::size_t end = std::max(begin, positions.byte_at(it.range->second));
      bytes.replace(begin, end - begin, it.text);
    } else {
      bytes = it.text;
    }
  }
  text = std::make_shared<const OpenText>(std::move(bytes));
  is_dirty = true;
}

void Workspace::open(const std::string& uri, std::string text, std::int64_t version) {
  OpenFile file;
  file.uri = uri;
  file.path = path_of_uri(uri);
  file.identity = file_identity(file.path);
  file.text = std::make_shared<const OpenText>(std::move(text));
  file.version = version;
  files_.insert_or_assign(uri, std::move(file));
}

OpenFile* Workspace::find(const std::string& uri) {
  const auto it = files_.find(uri);
  return it == files_.end() ? nullptr : &it->second;
}

void Workspace::mark_dirty(const OpenFile& changed) {
  const std::string& identity = changed.identity;
  for (auto& [uri, file] : files_) {
    if (file.identity == identity) file.is_dirty = true;
    if (file.analysis == nullptr) continue;
    // Where something is wrong, not all that it needs may have been found.
    const bool has_errors =
        std::ranges::any_of(file.analysis->diagnostics,
                            [](const Diagnostic& it) { return it.severity == Severity::Error; });
    file.is_dirty |=
        has_errors || std::ranges::any_of(file.analysis->texts, [&](const auto& source) {
          return file_identity(source->path()) == identity;
        });
  }
}

void Workspace::mark_all_dirty() {
  for (auto& [uri, file] : files_) file.is_dirty = true;
}

UnsavedTexts Workspace::texts() const {
  UnsavedTexts texts;
  for (const auto& [uri, file] : files_) texts[file.identity] = file.shared_bytes();
  return texts;
}

std::string Workspace::uri_of(const std::string& path) const {
  const std::string identity = file_identity(path);
  for (const auto& [uri, file] : files_) {
    if (file.path == path || file.identity == identity) return uri;
  }
  return uri_of_path(path);
}

}  // namespace lockstep::host
