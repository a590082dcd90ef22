// Waits for changes of files, for --watch.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lockstep::host {

class FileWatch {
 public:
  // Watches the folders of these paths, and those below them.
  explicit FileWatch(const std::vector<std::string>& paths) : paths_(paths) {}

  // From now on changes count, also those that come before wait().
  void begin() { before_ = times(); }
  // Until there is one. False: a signal came.
  bool wait() const;

 private:
  using Times = std::map<std::string, std::filesystem::file_time_type>;
  Times times() const;

  const std::vector<std::string>& paths_;
  Times before_;
};

}  // namespace lockstep::host
