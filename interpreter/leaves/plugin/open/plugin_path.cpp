#include "leaves/plugin/open/plugin_path.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/core/audience.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoDirectory = "is not found: there is no directory to search";

// The names that could be found in the directories.
std::vector<std::string> available(std::span<const std::string> directories) {
  std::vector<std::string> names;
  for (const std::string& directory : directories) {
    std::error_code error;
    fs::directory_iterator entry(directory, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      if (entry->path().extension() == ".so") names.push_back(entry->path().stem().string());
    }
  }
  std::ranges::sort(names);
  return names;
}

// The default file name that build systems give to a library; "" when it is not there.
std::string with_prefix(std::string_view name, std::span<const std::string> directories) {
  for (const std::string& directory : directories) {
    auto file = fs::path(directory) / fmt::format("lib{}.so", name);
    std::error_code error;
    if (fs::exists(file, error)) return file.string();
  }
  return {};
}

}  // namespace

std::string add_directory(std::string_view what) {
  return fmt::format(
      "add the directory that has {} to the plugin path{}", what,
      worded(": --plugin-path, or LOCKSTEP_PLUGIN_PATH", ", or to LOCKSTEP_PLUGIN_PATH"));
}

Result<std::string> find_plugin_file(std::string_view name,
                                     std::span<const std::string> directories) {
  for (const std::string& directory : directories) {
    std::string path = (fs::path(directory) / fmt::format("{}.so", name)).string();
    std::error_code error;
    if (fs::exists(path, error)) return path;
  }
  if (directories.empty()) {
    return problem(kNoDirectory, add_directory("it"));
  }
  const std::string message =
      fmt::format("is not found: '{}.so' is not in {}", brief(name), joined(directories, ", "));
  if (const std::string file = with_prefix(name, directories); !file.empty()) {
    return problem(message, fmt::format("'{0}' exists: rename it to '{1}.so' (in CMake: "
                                        "lockstep_add_plugin, or PREFIX \"\")",
                                        file, name));
  }
  if (const std::string program = program_named(name, directories); !program.empty()) {
    return problem(
        message,
        fmt::format("'{0}' is a program: <plugin name=\"{1}\" program=\"{0}\"/>", program, name));
  }
  const std::vector<std::string> names = available(directories);
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  std::string hint = did_you_mean(name, candidates);
  if (hint.empty()) hint = add_directory("it");
  return problem(message, std::move(hint));
}

std::string program_named(std::string_view name, std::span<const std::string> directories) {
  std::vector<std::string> found;
  for (const std::string& directory : directories) {
    std::error_code error;
    fs::directory_iterator entry(directory, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      const fs::path& path = entry->path();
      const bool is_called_so = path.filename() == name || path.stem() == name;
      if (is_called_so && path.extension() != ".so" && is_executable(path)) {
        found.push_back(path.filename().string());
      }
    }
    if (!found.empty()) return std::ranges::min(found);  // of several the same in each run
  }
  return {};
}

bool is_executable(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

Result<std::string> find_program_file(std::string_view file,
                                      std::span<const std::string> directories) {
  for (const std::string& directory : directories) {
    std::string path = (fs::path(directory) / file).string();
    std::error_code error;
    if (!fs::exists(path, error)) continue;
    if (is_executable(path)) return path;
    return problem(fmt::format("is a program that cannot be executed: '{}'", path),
                   fmt::format("chmod +x '{}'", path));
  }
  if (directories.empty()) return problem(kNoDirectory, add_directory("it"));
  return problem(fmt::format("is not found: the program '{}' is not in {}", brief(file),
                             joined(directories, ", ")),
                 add_directory("it"));
}

}  // namespace lockstep::host
