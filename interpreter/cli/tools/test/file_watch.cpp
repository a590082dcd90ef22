#include "cli/tools/test/file_watch.h"

#include <chrono>
#include <thread>

#include "run/stop_signals.h"

namespace lockstep::host {

// The times of the files that scenarios are made of. Others, such as recordings of failures, start
// nothing.
FileWatch::Times FileWatch::times() const {
  Times times;
  std::error_code error;
  const auto add = [&](const std::filesystem::path& path) {
    if (path.extension() == ".xml")
      times[path.string()] = std::filesystem::last_write_time(path, error);
  };
  for (const std::string& path : paths_) {
    const std::filesystem::path folder = std::filesystem::is_directory(path, error)
                                             ? std::filesystem::path(path)
                                             : std::filesystem::path(path).parent_path();
    std::filesystem::recursive_directory_iterator it(folder.empty() ? "." : folder, error), end;
    for (; !error && it != end; it.increment(error)) add(it->path());
  }
  return times;
}

bool FileWatch::wait() const {
  constexpr std::chrono::milliseconds kBetweenLooks{200};
  while (StopSignals::received() == 0) {
    if (times() != before_) return true;
    std::this_thread::sleep_for(kBetweenLooks);
  }
  return false;
}

}  // namespace lockstep::host
