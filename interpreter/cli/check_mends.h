// Messages of `lockstep check` with the bytes that they are about, and what mends them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/load/load_options.h"
#include "tree/mend/mends.h"

namespace lockstep::host {

struct MendableMessage {
  Diagnostic message;
  std::optional<ByteRange> place = {};  // none: it is about no file that can be read again
  std::vector<Mend> mends = {};
};

// Of one check.
class MessageMends {
 public:
  // With the leaves of these plugins.
  explicit MessageMends(std::shared_ptr<const PluginSet> plugins) : plugins_(std::move(plugins)) {}

  // What was checked in place of the file on the disk.
  void set_text(const std::string& path, std::string text);
  std::vector<MendableMessage> of(std::span<const Diagnostic> messages);

 private:
  struct File {
    std::string text;
    TolerantTree tree;
    Catalog catalog;
    std::optional<Mends> mends;
  };
  const File* file(const std::string& path);

  std::shared_ptr<const PluginSet> plugins_;
  std::map<std::string, std::unique_ptr<File>> files_;  // null: it cannot be read
};

// Applies the certain mends of a file, and those of what they reveal, and says so on stderr.
// Another file, as one that it includes, is not changed. Returns the exit code if the file cannot
// be written.
int mend_file(const std::string& path, const LoadCommandOptions& load);

}  // namespace lockstep::host
