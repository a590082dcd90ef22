#include "leaves/plugin/open/trust.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace lockstep::host {
namespace {

// The sticky bit of a directory keeps others from replacing what is there, not from adding to it.
bool is_world_writable(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && (status.st_mode & S_IWOTH) != 0;
}

void warn_of(const std::string& path, std::string_view what, const SourceLocation& where,
             Diagnostics& diagnostics) {
  if (!is_world_writable(path)) return;
  diagnostics.warning(
      "writable-by-all"_code, where,
      fmt::format("everyone may write to the {} '{}' and so control this program", what, path),
      fmt::format("chmod o-w '{}'", path));
}

// The directory that the file lies in and, if it is a symbolic link, those of all that it leads to:
// who may write to one of them can put another file in the place.
std::vector<std::string> directories_of(std::filesystem::path path) {
  constexpr int kMostLinks = 40;  // as the kernel has it
  std::vector<std::string> directories;
  for (int links = 0; links <= kMostLinks; ++links) {
    const auto parent = path.has_parent_path() ? path.parent_path() : ".";
    if (std::ranges::find(directories, parent.string()) == directories.end()) {
      directories.push_back(parent.string());
    }
    std::error_code error;
    const auto target = std::filesystem::read_symlink(path, error);
    if (error) break;
    const auto behind = parent / target;
    path = std::filesystem::canonical(behind.parent_path(), error) / behind.filename();
    if (error) break;
  }
  return directories;
}

}  // namespace

void warn_of_writable_plugin(const std::string& path, const SourceLocation& where,
                             Diagnostics& diagnostics) {
  warn_of(path, "plugin", where, diagnostics);
  for (const std::string& directory : directories_of(path)) {
    warn_of(directory, "plugin directory", where, diagnostics);
  }
}

void warn_of_writable_directories(std::span<const std::string> directories,
                                  const SourceLocation& where, Diagnostics& diagnostics) {
  for (const std::string& directory : directories) {
    warn_of(directory, "plugin directory", where, diagnostics);
  }
}

}  // namespace lockstep::host
