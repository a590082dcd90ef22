#include "cli/tools/test/file_watch.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <thread>

#include "runtime/stop_signals.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kBetweenLooks{200};

using Times = std::map<std::string, fs::file_time_type>;

// Of the files that scenarios are made of, so that recordings of failures start nothing.
Times times_of(const std::vector<std::string>& paths) {
  Times times;
  std::error_code error;
  const auto add = [&](const fs::path& path) {
    const fs::path extension = path.extension();
    if (extension != ".xml" && extension != ".leaves") return;
    times[path.string()] = fs::last_write_time(path, error);
  };
  for (const std::string& path : paths) {
    const fs::path folder =
        fs::is_directory(path, error) ? fs::path(path) : fs::path(path).parent_path();
    fs::recursive_directory_iterator it(folder.empty() ? "." : folder, error), end;
    for (; !error && it != end; it.increment(error)) add(it->path());
  }
  return times;
}

}  // namespace

bool wait_for_change(const std::vector<std::string>& paths) {
  const Times before = times_of(paths);
  while (StopSignals::received() == 0) {
    std::this_thread::sleep_for(kBetweenLooks);
    if (times_of(paths) != before) return true;
  }
  return false;
}

}  // namespace lockstep::host
