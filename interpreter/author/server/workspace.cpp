#include "author/server/workspace.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "author/server/uri.h"

namespace lockstep::host {
namespace {

// Whether a text that was not read, as one without a tree that is sought, may change the message.
bool is_about_others(const Diagnostic& it) {
  constexpr std::string_view kCodes[] = {"unknown-tree"_code.text(), "duplicate-tree"_code.text(),
                                         "bad-include"_code.text(), "unreadable-file"_code.text()};
  return std::ranges::find(kCodes, it.code.text()) != std::end(kCodes);
}

}  // namespace

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
  std::string_view last;  // in one file after the other
  bool is_in_changed = false;
  const auto is_in = [&](const std::string& path) {
    if (path != last) is_in_changed = file_identity(path) == identity;
    last = path;
    return is_in_changed;
  };
  for (auto& [uri, file] : files_) {
    // What a job that has not ended reads is not known yet.
    const bool is_checked = file.analysis != nullptr && file.analysis->serial == file.serial;
    if (file.identity == identity || !is_checked) file.is_dirty = true;
    if (file.is_dirty) continue;
    file.is_dirty = std::ranges::any_of(file.analysis->diagnostics,
                                        [&](const Diagnostic& it) {
                                          return is_about_others(it) || is_in(it.location.file);
                                        }) ||
                    std::ranges::any_of(file.analysis->texts,
                                        [&](const auto& source) { return is_in(source->path()); });
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
