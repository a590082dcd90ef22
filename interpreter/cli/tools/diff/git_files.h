// The tree files of a revision, for a short time in a folder: a tree is read there as it is read
// everywhere, with its includes and its project file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/core/diagnostics.h"
#include "base/core/problem.h"

namespace lockstep::host {

class GitFiles {
 public:
  // All XML files of the repository that `path` is in, as the revision has them. A Problem if git,
  // the repository, the revision or the file is missing. `path` need not exist any more.
  static Result<GitFiles> read(const std::string& revision, const std::string& path);
  ~GitFiles();
  GitFiles(GitFiles&& other) noexcept;
  GitFiles(const GitFiles&) = delete;
  GitFiles& operator=(const GitFiles&) = delete;
  GitFiles& operator=(GitFiles&&) = delete;

  // Where the file is now.
  std::string file() const { return (folder_ / below_).string(); }
  // "HEAD~1:trees/cart.xml", as git writes it.
  std::string name() const { return revision_ + ':' + below_.string(); }
  // The same in place of each path of the folder that a text has.
  std::string as_named(std::string text) const;
  Diagnostics as_named(const Diagnostics& diagnostics) const;

 private:
  GitFiles() = default;

  std::filesystem::path folder_, below_;
  std::string revision_;
};

}  // namespace lockstep::host
