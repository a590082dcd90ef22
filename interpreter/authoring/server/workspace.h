// The files that are open in the editor, with what was found in each of them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "authoring/server/analysis.h"
#include "authoring/server/positions.h"

namespace lockstep::host {

struct OpenFile {
  std::string uri, path;
  std::string identity;  // file_identity()
  std::shared_ptr<std::string> text;
  std::int64_t version = 0;
  bool is_dirty = true;                           // no job was posted for this text
  std::shared_ptr<const Analysis> analysis = {};  // of this text or an earlier one; null: none yet

  // Replaces a part of the text, or all of it.
  void change(const std::optional<std::pair<Position, Position>>& range, std::string_view by);
  const Positions& positions() const;

 private:
  mutable std::optional<Positions> positions_;
};

class Workspace {
 public:
  void open(const std::string& uri, std::string text, std::int64_t version);
  // Null: it is not open.
  OpenFile* find(const std::string& uri);
  void close(const std::string& uri) { files_.erase(uri); }
  // It, and all that include it.
  void mark_dirty(const OpenFile& changed);
  void mark_all_dirty();
  UnsavedTexts texts() const;
  std::map<std::string, OpenFile>& files() { return files_; }
  const std::map<std::string, OpenFile>& files() const { return files_; }
  // As the editor calls it, if it is open.
  std::string uri_of(const std::string& path) const;

 private:
  std::map<std::string, OpenFile> files_;  // by their URI
};

}  // namespace lockstep::host
