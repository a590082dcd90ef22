#include "plugin/trust.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>

namespace lockstep {
namespace {

// The sticky bit of a directory keeps others from replacing what is there, not from adding to it.
bool is_world_writable(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && (status.st_mode & S_IWOTH) != 0;
}

void warn_of(const std::string& path, std::string_view what, const SourceLocation& where,
             Diagnostics& diagnostics) {
  if (!is_world_writable(path)) return;
  diagnostics.add(
      {.severity = Severity::Warning,
       .location = where,
       .message = fmt::format(
           "everyone may write to the {} '{}', and so decide what this program does", what, path),
       .hint = fmt::format("chmod o-w '{}'", path),
       .excerpt = {}});
}

}  // namespace

void warn_of_writable_plugin(const std::string& path, const SourceLocation& where,
                             Diagnostics& diagnostics) {
  warn_of(path, "plugin", where, diagnostics);
  const auto parent = std::filesystem::path(path).parent_path().string();
  warn_of(parent.empty() ? "." : parent, "plugin directory", where, diagnostics);
}

void warn_of_writable_directories(std::span<const std::string> directories,
                                  const SourceLocation& where, Diagnostics& diagnostics) {
  for (const std::string& directory : directories) {
    warn_of(directory, "plugin directory", where, diagnostics);
  }
}

}  // namespace lockstep
