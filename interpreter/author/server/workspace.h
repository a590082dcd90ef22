// The files that are open in the editor, with what was found in each of them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "author/server/analysis.h"
#include "author/server/positions.h"
#include "author/server/protocol/params.h"

namespace lockstep::host {

// A text in the editor. It never changes: an edit makes another one, so any thread that has it may
// read its bytes. Its positions and its tree are views of them, for the server's thread only.
class OpenText {
 public:
  explicit OpenText(std::string bytes) : bytes_(std::move(bytes)) {}
  OpenText(const OpenText&) = delete;
  OpenText& operator=(const OpenText&) = delete;

  const std::string& bytes() const { return bytes_; }
  const Positions& positions() const;
  const TolerantTree& tree() const;

 private:
  const std::string bytes_;
  mutable std::optional<Positions> positions_;
  mutable std::optional<TolerantTree> tree_;
};

struct OpenFile {
  std::string uri, path;
  std::string identity;  // file_identity()
  std::shared_ptr<const OpenText> text;
  std::int64_t version = 0;
  bool is_dirty = true;                           // no job was posted for this text
  std::uint64_t serial = 0;                       // of the last job that was
  std::int64_t told = -1;                         // the version of which the client has messages
  std::shared_ptr<const Analysis> analysis = {};  // of this text or an earlier one; null: none yet

  // One after the other: each is about the text that the one before it has made.
  void change(std::span<const TextChange> changes);
  const std::string& bytes() const { return text->bytes(); }
  // The bytes alone, for another thread.
  std::shared_ptr<const std::string> shared_bytes() const { return {text, &text->bytes()}; }
  const Positions& positions() const { return text->positions(); }
  const TolerantTree& tree() const { return text->tree(); }
  // All that can be found is found.
  bool is_settled() const {
    return !is_dirty && analysis != nullptr && analysis->serial == serial && analysis->is_whole;
  }
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
