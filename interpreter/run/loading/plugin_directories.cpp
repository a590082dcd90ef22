#include "run/loading/plugin_directories.h"

#include <fmt/format.h>
#include <sys/auxv.h>

#include <cstdlib>
#include <sstream>

#include "base/core/audience.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariable = "LOCKSTEP_PLUGIN_PATH";
// The prefixes of ROS 2 and of its workspaces. A package installs plugins in a folder below.
constexpr const char* kRosVariable = "AMENT_PREFIX_PATH";
constexpr const char* kFolderOfPackage = "lib/lockstep/plugins";

// The directories of a variable of the environment; none when privileged.
std::vector<std::string> listed_in(const char* variable) {
  std::vector<std::string> directories;
  const char* const path = secure_getenv(variable);
  std::istringstream list(path == nullptr ? "" : path);
  for (std::string directory; std::getline(list, directory, ':');) {
    if (!directory.empty()) directories.push_back(directory);
  }
  return directories;
}

bool check_absolute(const std::string& path, std::string_view option, Diagnostics& diagnostics) {
  if (fs::path(path).is_absolute()) return true;
  diagnostics.error("untrusted-path"_code, {},
                    fmt::format("{} {}: a program with more rights than its user refuses a "
                                "relative path",
                                option, path),
                    "give the absolute path");
  return false;
}

void warn_of_missing_directories(const PluginOptions& options, Diagnostics& diagnostics) {
  for (const std::string& directory : options.directories) {
    std::error_code error;
    if (fs::is_directory(directory, error)) continue;
    diagnostics.warning("missing-directory"_code, {},
                        fmt::format("{} {}: there is no such directory",
                                    worded("--plugin-path", "plugin path"), directory));
  }
}

}  // namespace

bool is_privileged() {
  return getauxval(AT_SECURE) != 0;
}

fs::path program_directory(const PluginOptions& options) {
  if (!options.program_directory.empty()) return options.program_directory;
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

std::vector<std::string> plugin_directories(const PluginOptions& options) {
  std::vector<std::string> directories = options.directories;
  if (is_privileged()) {
    std::erase_if(directories, [](const auto& it) { return !fs::path(it).is_absolute(); });
  }
  for (std::string& directory : listed_in(kVariable)) directories.push_back(std::move(directory));
  for (const std::string& prefix : listed_in(kRosVariable)) {
    std::error_code error;
    const fs::path folder = fs::path(prefix) / kFolderOfPackage;
    if (fs::is_directory(folder, error)) directories.push_back(folder.string());
  }
  if (const auto beside = program_directory(options); !beside.empty()) {
    directories.push_back((beside / "plugins").string());  // in a build directory
    directories.push_back((beside / LOCKSTEP_PLUGINS_FROM_BIN).lexically_normal().string());
  }
  std::error_code none;
  const bool may_search = !is_privileged() || fs::path(options.project_build).is_absolute();
  if (may_search && fs::is_directory(options.project_build, none)) {
    directories.push_back(options.project_build);
  }
  return directories;
}

bool check_plugin_options(const PluginOptions& options, Diagnostics& diagnostics) {
  warn_of_missing_directories(options, diagnostics);
  if (!is_privileged()) return true;
  if (std::getenv(kVariable) != nullptr) {
    diagnostics.warning("untrusted-path"_code, {},
                        fmt::format("{} is not read: this program has more rights than its "
                                    "user",
                                    kVariable),
                        worded("give --plugin-path", "add the directories to the project"));
  }
  bool good = true;
  for (const std::string& directory : options.directories) {
    good &= check_absolute(directory, worded("--plugin-path", "plugin path"), diagnostics);
  }
  for (const std::string& plugin : options.plugins) {
    if (!is_plugin_file(plugin)) continue;
    good &= check_absolute(plugin, worded("--plugin", "plugin"), diagnostics);
  }
  return good;
}

}  // namespace lockstep::host
