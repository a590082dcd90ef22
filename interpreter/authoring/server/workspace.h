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
  std::uint64_t serial = 0;                       // of the last job that was
  std::int64_t told = -1;                         // the version of which the client has messages
  std::shared_ptr<const Analysis> analysis = {};  // of this text or an earlier one; null: none yet

  // Replaces a part of the text, or all of it.
  void change(const std::optional<std::pair<Position, Position>>& range, std::string_view by);
  const Positions& positions() const;
  const TolerantTree& tree() const;
  // All that can be found is found.
  bool is_settled() const {
    return !is_dirty && analysis != nullptr && analysis->serial == serial && analysis->is_whole;
  }

 private:
  mutable std::optional<Positions> positions_;
  mutable std::optional<TolerantTree> tree_;
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
